"""Flocking, the complex skill: who is in charge, and how much (thesis, figure 2.22)."""

TOO_NEAR = 0.25  # share of the sight within which a flockmate is too near


def flocking(centre_away, nearest_away, company, cohesion, separation, alignment):
    """Give influence to the three base skills, as distance and number of flockmates ask for.

    Not to touch comes first. A boid with much company follows its flockmates' heading, one with
    little or at the edge goes to their middle; alone, it follows none of the three.
    """
    if company == 0:
        return 0.0, 0.0, 0.0
    crowded = max(0.0, 1.0 - nearest_away / TOO_NEAR)
    free = 1.0 - crowded
    lonely = centre_away * (1.0 - 0.5 * company)
    return cohesion * free * lonely, separation * crowded, alignment * free * (1.0 - 0.5 * lonely)
