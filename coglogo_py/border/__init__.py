"""What users give, held against what it may be: errors, numbers, memory, names."""
