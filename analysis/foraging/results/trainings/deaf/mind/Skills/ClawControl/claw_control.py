def claw_control(SENSOBJ, SENSDZ):
    """Close on an object in reach, open in the drop zone, else leave the claw as it is."""
    if SENSDZ > 0.5:
        return 0.0
    if SENSOBJ > 0.5:
        return 1.0
    return 0.5
