"""What is measured of a run that is still in memory."""
