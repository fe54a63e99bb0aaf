"""What commands share: options, progress, what a terminal can show, how they stop."""
