"""What the outputs of a sweep depend on: indices of sensitivity, luck, tables, figures."""
