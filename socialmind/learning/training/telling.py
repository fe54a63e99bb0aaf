"""What is said of a training while it goes on: a line that changes with each generation."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager

from socialmind.learning.training.attempt import News
from socialmind.work.progress import progress_line

OnGeneration = Callable[[News, float | None], None]


@contextmanager
def told_of_generations(
    progress: bool | None, kind: str, told: OnGeneration | None = None
) -> Iterator[OnGeneration | None]:
    """Show each generation.

    Args:
        progress: whether a line is shown; None where somebody looks, and no caller is told.
        kind: what runs, by which the time that compiling takes is remembered.
        told: the caller's own, who is told as well.

    Yields:
        Who is to be told; None where nobody wants to know.
    """
    wanted = False if progress is None and told is not None else progress
    with progress_line(wanted, kind, "learning") as show:

        def tell(news: News, left: float | None) -> None:
            if show is not None:
                lesson = news.lesson
                show(line_of(news, left), news.generation, lesson.starts * lesson.generations)
            if told is not None:
                told(news, left)

        yield told if show is None else tell


def line_of(news: News, left: float | None) -> str:
    """Return what is said of a generation.

    Args:
        news: of the generation.
        left: the seconds left; None where nobody knows.
    """
    speed = news.ticks / max(news.seconds, 1e-9)
    parts = [
        f"attempt {news.attempt}, {news.lesson.name}",
        f"generation {news.generation:,} of {news.lesson.starts * news.lesson.generations:,}",
        f"best {news.best:.4g}",
        f"mean {news.mean:.4g}",
        f"{speed:,.0f} ticks/s",
    ]
    if left is not None:
        parts.append(f"{clock(left)} left")
    return "  ".join(parts)


def clock(seconds: float) -> str:
    """Return a time as hours, minutes and seconds.

    >>> clock(3725.2)
    '1:02:05'
    """
    minutes, rest = divmod(round(seconds), 60)
    return f"{minutes // 60}:{minutes % 60:02d}:{rest:02d}"
