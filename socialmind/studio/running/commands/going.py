"""Societies go on, stand, and go to another tick."""

from __future__ import annotations

from socialmind.studio.running.stage import Stage


def go(stage: Stage) -> None:
    """Let it run until it is told otherwise."""
    stage.go()


def pause(stage: Stage) -> None:
    """Let it stand."""
    stage.stand()
    stage.show()


def step(stage: Stage, ticks: int = 1, together: bool = False) -> None:
    """Run some ticks, and stand.

    Args:
        stage: whose society does.
        ticks: how many.
        together: whether it is one of several that go on together, and more are to come.
    """
    stage.stand()
    stage.together = together
    stage.step(int(ticks))
    society = stage.run.society
    over = bool(society.stopped)
    if over:
        stage.say("over", why=society.over)
    stage.say("stood", tick=stage.run.tick, over=over)


def turn(stage: Stage) -> None:
    """Let the next agent have its turn, and stand within the tick."""
    stage.stand()
    stage.take_turn()


def pace(stage: Stage, ticks: int | str | None) -> None:
    """Set the ticks between two frames; "turn", an agent's turn; None, as fast as possible."""
    stage.pace = ticks if ticks is None or ticks == "turn" else max(1, int(ticks))


def go_to(stage: Stage, tick: int) -> None:
    """Show the society as it was at another tick, or will be."""
    stage.stand()
    stage.prepare(stage.run)
    stage.say("preparing", text="going there")
    try:
        stage.run.go_to(max(0, int(tick)))
    finally:
        stage.say("preparing", text="")
    stage.moved()
