"""Drive: push a sheep on."""


def drive(stray):
    """Walk at the stray, which then flees."""
    return 0.5 + 2.0 * (stray - 0.5), 0.6
