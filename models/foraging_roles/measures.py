"""What is measured: how far the split of roles is from the wanted one, and whether it settled.

These are the measures of `socialmind.experiments.settling` with a record of every tick, counted
while the world runs, since scores keep no records. A record's tick is how many have run before it.
"""

from socialmind.worlds.plane import Measure

FARTHEST_OFF = 3  # robots off the wanted split up to which it is watched
HOLD = 5000  # ticks within one robot of the wanted split that count as settled


def watch_start(model):
    """See the split of roles before the first tick."""
    see_split(model, 0)


def watch(model):
    """See the split of roles that a tick leaves."""
    see_split(model, model.tick + 1)


def see_split(model, now):
    """See how far the split of roles is from the wanted one, and whether it has settled."""
    robots = 0
    in_b = 0
    for robot in model.robots:
        robots += 1
        if robot.is_b:
            in_b += 1
    model.robot_ticks += min(robots, model.present)
    model.in_b = in_b
    model.present = robots
    model.changes_seen = model.changed
    model.off = abs(in_b - model.wanted * robots)
    for beyond in range(FARTHEST_OFF):
        if model.off > beyond + 1 + 1e-9:
            model.last_beyond[beyond] = now
    if model.off > 1 + 1e-9:
        model.within_since = -1
    else:
        if model.within_since == -1:
            model.within_since = now
            model.changes_before = model.changed
        if model.settled_at == -1 and now - model.within_since >= HOLD:
            model.settled_at = model.within_since
            model.changes_settled = model.changes_before


def begin_anew(model):
    """Wait once more for the roles to settle, after a shock; add up what was settled until then."""
    if model.settled_at >= 0:
        model.settled_changes += model.changes_seen - model.changes_settled
        model.settled_robot_ticks += model.present * (model.tick - model.settled_at)
    model.began_at = model.tick + 1
    model.within_since = -1
    model.settled_at = -1


def stays_within(robots):
    """Measure whether the last quarter stays within so many robots of the wanted split, 1 or 0."""

    def within(last_beyond, ticks):
        return float(last_beyond[robots - 1] < 0.75 * ticks)

    return Measure(within)


def changes_after_settling(
    changed,
    robot_ticks,
    present,
    settled_at,
    changes_settled,
    settled_changes,
    settled_robot_ticks,
    ticks,
):
    """Return the changes of roles for each robot and 10,000 ticks while the roles were settled.

    All of the run counts where they never were.
    """
    changes, lived = settled_changes, settled_robot_ticks
    if settled_at >= 0:
        changes += changed - changes_settled
        lived += present * (ticks - settled_at)
    if lived == 0:
        changes, lived = changed, robot_ticks
    return changes / max(lived, 1) * 10_000


def ticks_to_settle(settled_at, began_at, ticks):
    """Return the ticks from the start, or the last shock, until the roles settled.

    Where they never do, it is all the ticks that there were.
    """
    return (settled_at if settled_at >= 0 else ticks) - began_at
