"""What is done to a society from outside, between two ticks: shocks and changes."""
