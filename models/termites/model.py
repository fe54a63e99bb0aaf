"""Termites that gather wood chips into piles, though nobody plans a pile.

A termite knows nothing but what lies under it: it carries a chip until it meets another, and puts
it down beside that (Resnick, 1994; thesis, section 2.5.1). With several kinds of chips, it looks
for one of the kind that it carries, and so they are sorted.
"""

import numpy as np

from socialmind import Agent, Model, Patch, Population, Torus, each, once, parameter

NOTHING = 0  # in place of a kind of chip; kinds are counted from 1
TURN = 50  # degrees to either side, while a termite wanders


class Termite(Agent):
    """A termite: the chip that it carries, and what it is about to do."""

    chip: int = NOTHING
    placing: bool = False
    leaving: int = 0
    moved: int = 0


class Ground(Patch):
    """A patch, and the kind of the chip that lies there."""

    chip: int = NOTHING


# Setup ------------------------------------------------------------------------------------------


def scatter(model, rng):
    """Scatter the chips: one on a patch, any patches as likely as any others, of any kinds."""
    patches = model.world.size * model.world.size
    chips = round(model.density * patches)
    for patch in model.world.patches:
        if rng.random() * patches < chips:
            patch.chip = 1 + rng.integers(model.n_kinds)
            chips -= 1
        patches -= 1


def arrive(termite, model, rng):
    """Put a termite on a random place."""
    termite.x = rng.uniform(model.world.low - 0.5, model.world.high + 0.5)
    termite.y = rng.uniform(model.world.low - 0.5, model.world.high + 0.5)
    termite.heading = rng.uniform(0.0, 360.0)


# A tick -----------------------------------------------------------------------------------------


def work(termite, model, rng):
    """Go a step, and do what there is to do with what lies there."""
    if termite.leaving > 0:
        termite.leaving -= 1
        model.world.forward(termite, 1)
        return
    if termite.placing:
        termite.heading = rng.uniform(0.0, 360.0)
    else:
        model.world.right(termite, rng.integers(TURN))
        model.world.left(termite, rng.integers(TURN))
    model.world.forward(termite, 1)
    patch = model.world.patch(termite.x, termite.y)
    if termite.chip == NOTHING:
        pick_up(termite, patch, model)
    elif termite.placing and patch.chip == NOTHING:
        put_down(termite, patch, model)
    else:
        termite.placing = patch.chip == termite.chip


def pick_up(termite, patch, model):
    """Pick up the chip that lies here, if any, and go away from where it lay."""
    if patch.chip != NOTHING:
        termite.chip = patch.chip
        patch.chip = NOTHING
        termite.leaving = model.away


def put_down(termite, patch, model):
    """Put the chip down here, and go away from where it lies."""
    patch.chip = termite.chip
    termite.chip = NOTHING
    termite.placing = False
    termite.leaving = model.away
    termite.moved += 1


# What is counted --------------------------------------------------------------------------------

AROUND = ((0, 1), (1, 1), (1, 0), (1, -1), (0, -1), (-1, -1), (-1, 0), (-1, 1))


def beside(chips, dx, dy):
    """Return what lies on the patch so far east and north of each, round the world."""
    return np.roll(chips, (-dx, -dy), axis=(0, 1))


def pile_sizes(chips):
    """Return the sizes of all piles, an array: chips of a kind that lie beside each other.

    Args:
        chips: the kind on each patch, (width, height), 0 for none; the world wraps.
    """
    label = np.arange(chips.size).reshape(chips.shape)
    while True:
        before = label
        for dx, dy in AROUND:
            same = (chips != NOTHING) & (beside(chips, dx, dy) == chips)
            label = np.where(same, np.minimum(label, beside(label, dx, dy)), label)
        label = label.ravel()[label]  # the label of the patch that it is named after
        if (label == before).all():
            sizes = np.bincount(label[chips != NOTHING], minlength=1)
            return sizes[sizes > 0]


def togetherness(chips):
    """Return the share of the eight patches around a chip that have one of its kind, and by chance.

    Args:
        chips: the kind on each patch, (width, height), 0 for none; the world wraps.

    Returns:
        The mean share over all chips, and what it is on the mean where chips of these kinds are
        scattered anew; both 0 without chips.
    """
    lying = chips != NOTHING
    if not lying.any():
        return 0.0, 0.0
    alike = [(beside(chips, dx, dy) == chips)[lying].mean() for dx, dy in AROUND]
    kinds = np.bincount(chips[lying]).astype(float)
    by_chance = (kinds * (kinds - 1)).sum() / (kinds.sum() * (chips.size - 1))
    return float(np.mean(alike)), float(by_chance)


class Termites(Model):
    """Termites that gather chips into piles, each by what lies under it (Resnick, 1994)."""

    ticks = 20_000

    n_termites: int = parameter(50, unit="termites", low=0, high=10_000, doc="termites")
    density: float = parameter(
        0.2, unit="share of patches", low=0.0, high=0.9, doc="patches with a chip at the start"
    )
    n_kinds: int = parameter(1, unit="kinds", low=1, high=4, doc="kinds of chips")
    away: int = parameter(
        20, unit="steps", low=0, high=200, doc="walked straight on after taking or leaving a chip"
    )
    world_size: int = parameter(51, unit="patches", low=3, high=1000, doc="side of the world")

    world = Torus("world_size", Ground)
    termites = Population(Termite, "n_termites")

    setup = (once(scatter), each(termites, arrive))
    schedule = (each(termites, work),)

    def series(self):
        """Return chips on the ground and carried, their piles, and how much they lie together."""
        chips = self.world.chip
        sizes = pile_sizes(chips)
        together, by_chance = togetherness(chips)
        return {
            "chips": int((chips != NOTHING).sum()),
            "carried": int((self.termites.chip != NOTHING).sum()),
            "piles": len(sizes),
            "largest": int(sizes.max(initial=0)),
            "together": together,
            "by_chance": by_chance,
        }
