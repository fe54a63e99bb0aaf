"""Models of MetaCiv (2014 to 2017): their folders read, and written as models of this toolkit."""
