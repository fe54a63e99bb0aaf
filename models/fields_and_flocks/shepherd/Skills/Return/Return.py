"""Return: go home."""


def back_home(home, home_away):
    """Walk to the fold, slower as it comes near."""
    return 0.5 + 2.0 * (home - 0.5), 0.5 * home_away
