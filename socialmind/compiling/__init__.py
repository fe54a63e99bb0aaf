"""From typed rules to machine code: layout, lowering, modules and their cache."""
