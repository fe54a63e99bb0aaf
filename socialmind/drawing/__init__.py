"""How figures look: style, schemes, planes; functions that take and return Axes."""
