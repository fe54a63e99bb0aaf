"""Work, the master of shepherds: the plan says which skill is in charge."""


def work(herding):
    """Give all influence to herding, or to going home."""
    return herding, 1.0 - herding
