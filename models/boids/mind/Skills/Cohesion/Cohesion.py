"""Cohesion: stay close to the group."""


def cohesion(centre, centre_away):
    """Turn to the middle of the flockmates, the faster the further it is ahead."""
    turn = 0.5 + 2.0 * (centre - 0.5)
    ahead = 1.0 - 4.0 * abs(centre - 0.5)  # 1 straight ahead, 0 at a side, -1 behind
    return turn, 0.5 + 0.5 * centre_away * ahead
