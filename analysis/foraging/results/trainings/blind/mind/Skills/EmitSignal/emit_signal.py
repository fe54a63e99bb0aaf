def emit_signal(ACTOBJ):
    """Emit a signal as long as there are objects in sight."""
    return 1.0 if ACTOBJ > 0.5 else 0.0
