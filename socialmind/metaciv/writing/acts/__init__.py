"""The kinds of MetaCiv's actions as rules of ours, a file a theme."""
