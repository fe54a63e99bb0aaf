"""What a fit leaves: tables, what recovery says, figures, the page."""
