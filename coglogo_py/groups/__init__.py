"""Groups: their instances, who is in them, what they hold."""
