def claw_control(SENSOBJ, SENSDZ):
    if SENSDZ > 0.5:
        return 0.0
    if SENSOBJ > 0.5:
        return 1.0
    return 0.5
