"""What answers the page: who may ask, and the processes in which societies run."""
