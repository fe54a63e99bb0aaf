"""What is measured: how far the split of roles is from the wanted one, and whether it settled."""

from socialmind.worlds.plane import Measure

FARTHEST_OFF = 3  # robots off the wanted split up to which it is watched
HOLD = 5000  # ticks within one robot of the wanted split that count as settled


def begin_anew(model):
    """Wait once more for the roles to settle, at the start and after a shock."""
    model.began_at = model.tick
    model.within_since = -1
    model.settled_at = -1


def watch(model):
    """See how far the split of roles is from the wanted one, and whether it has settled."""
    robots = 0
    in_b = 0
    for robot in model.robots:
        robots += 1
        if robot.is_b:
            in_b += 1
    model.in_b = in_b
    model.present = robots
    model.off = abs(in_b - model.wanted * robots)
    for beyond in range(FARTHEST_OFF):
        if model.off > beyond + 1 + 1e-9:
            model.last_beyond[beyond] = model.tick
    if model.off > 1 + 1e-9:
        model.within_since = -1
    else:
        if model.within_since == -1:
            model.within_since = model.tick
            model.changes_before = model.changed
        if model.settled_at == -1 and model.tick - model.within_since >= HOLD:
            model.settled_at = model.within_since
            model.changes_settled = model.changes_before


def stays_within(robots):
    """Measure whether the last quarter stays within so many robots of the wanted split, 1 or 0."""

    def within(last_beyond, ticks):
        return float(last_beyond[robots - 1] <= 0.75 * ticks)

    return Measure(within)


def changes_after_settling(changed, present, changes_settled, settled_at, ticks):
    """Return the changes of roles for each robot and 10,000 ticks after settling.

    All of the run counts where the roles never settled; the robots are those at the end.
    """
    since, before = (settled_at, changes_settled) if settled_at >= 0 else (0, 0)
    return (changed - before) / max(present, 1) / max(ticks - since, 1) * 10_000


def ticks_to_settle(settled_at, began_at, ticks):
    """Return the ticks from the start, or the last shock, until the roles settled.

    Where they never do, it is all the ticks that there were.
    """
    return (settled_at if settled_at >= 0 else ticks) - began_at
