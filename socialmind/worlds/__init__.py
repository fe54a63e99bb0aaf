"""The worlds that agents live in; today the torus grid with NetLogo's geometry."""
