"""Flee: run from danger."""


def flee(danger):
    """Turn away from where the danger is, at full speed."""
    away = danger - 0.5 if danger >= 0.5 else danger + 0.5
    return 0.5 + 2.0 * (away - 0.5), 1.0
