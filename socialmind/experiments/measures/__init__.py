"""What is measured of societies: specialisation, settling, recovery, effects, intervals."""
