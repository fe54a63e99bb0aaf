"""Internal functions of skills; `contract` says what they have in common."""
