"""The results of the thesis beside ours: what was reproduced, what is different, what cannot tell.

A topic of `analysis/` may have a file `thesis.py` with ``results = (Result(…), …)``. What a result
says of ours is read from the tables that are kept beside the study, and so is whether it agrees:
nothing that is ours is typed, and a table that changes changes its verdict.
"""

from __future__ import annotations

import csv
import json
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from socialmind.errors import ModelError, SocialmindError
from socialmind.experiments import html
from socialmind.experiments.judging import CRITERION, Finding, Verdict
from socialmind.experiments.studies import Study, Way, catalogue_of_studies, declared_in, topics

THESIS_FILE = "thesis.py"
TIMES_FILE = "times.csv"
"""How long each study takes from what is kept, measured by `python -m analysis.times`."""
PAGE = "overview"

TITLE = "The thesis's results beside ours"
ABOUT = (
    "All tables and figures of François Suro's thesis (2020) that show results, with what it says "
    "of each, what ours say, and how they compare. Made by `socialmind reproduce --overview` from "
    "the tables that are kept beside the studies: each number of ours is read from them, and so is "
    "whether it agrees. An entry is *not comparable* unless more than half of its rows can be "
    "compared; else it is *reproduced* if all of these agree, *different* if some do not.",
    *CRITERION,
    "Times are seconds of one processor, for making the figure or table from kept results by all "
    "commands of an entry, as measured by `python -m analysis.times`; where it stands on "
    "trainings, those took the hours that their records tell. Budgets are of one attempt. The "
    "thesis tells generations, but neither how many individuals they have nor in how many worlds "
    "each is judged, so that ticks cannot be compared.",
)


@dataclass(frozen=True)
class Result:
    """A figure or table of the thesis.

    Attributes:
        name: what the thesis calls it: ``figure 6.2``, ``table 6.1``.
        shows: what it shows, in a line.
        study: the study that makes ours.
        found: gives the findings, from kept tables.
        thesis_budget: what the thesis gave an attempt; empty for what takes no training.
        budget: gives ours, from kept tables.
        trainings: those that ours stands on, of the topic's ``results/trainings``.
        also: further studies, which make the tables that some rows are read from.
        unkept: why trainings have no time, where they are not kept or only what came of them is.
        notes: gives what is to be known of several rows, a sentence or two each, from kept tables.
    """

    name: str
    shows: str
    study: str
    found: Callable[[], Sequence[Finding]]
    thesis_budget: str = ""
    budget: Callable[[], str] = str
    trainings: tuple[str, ...] = ()
    notes: Callable[[], Sequence[str]] = tuple
    also: tuple[str, ...] = ()
    unkept: str = ""


@dataclass(frozen=True)
class Entry:
    """A result as the overview shows it.

    Attributes:
        result: which.
        findings: its findings.
        commands: what makes ours from what is kept.
        time: how long that takes, in words, and its trainings.
        budget: ours.
        notes: of several rows.
    """

    result: Result
    findings: tuple[Finding, ...]
    commands: tuple[str, ...]
    time: str
    budget: str
    notes: tuple[str, ...] = ()

    @property
    def verdict(self) -> Verdict:
        """How ours compares, if most of it can be compared: different if anything is."""
        verdicts = [one.verdict for one in self.findings]
        apart = verdicts.count(Verdict.NOT_COMPARABLE)
        if 2 * apart >= len(verdicts):
            return Verdict.NOT_COMPARABLE
        return Verdict.DIFFERENT if Verdict.DIFFERENT in verdicts else Verdict.REPRODUCED

    @property
    def counted(self) -> str:
        """The verdict, with how many findings are of each kind where they are of several."""
        counts = {one: sum(f.verdict is one for f in self.findings) for one in Verdict}
        several = [f"{count} {one}" for one, count in counts.items() if count]
        return f"{self.verdict} ({', '.join(several)})" if len(several) > 1 else str(self.verdict)


def entries() -> list[Entry]:
    """All results of all topics, in the thesis's order.

    Raises:
        SocialmindError: a topic's file cannot be loaded, or a kept table is missing.
    """
    known = catalogue_of_studies()
    found = [
        _entry(result, folder, known)
        for folder in topics().values()
        if (folder / THESIS_FILE).is_file()
        for result in results_in(folder)
    ]
    return sorted(found, key=lambda one: place_of(one.result.name))


def commands() -> list[str]:
    """The commands that make what the overview shows, from what is kept, each once."""
    known = catalogue_of_studies()
    return list(
        dict.fromkeys(
            command
            for folder in topics().values()
            if (folder / THESIS_FILE).is_file()
            for result in results_in(folder)
            for command in commands_of(result, known)
        )
    )


def commands_of(result: Result, known: Mapping[str, tuple[Study, Path]]) -> tuple[str, ...]:
    """Return the commands that make a result from what is kept.

    Args:
        result: which.
        known: all studies.
    """
    for name in (result.study, *result.also):
        if name not in known:
            raise ModelError(f"study {name!r} for {result.name}", "the name of a study")
    return tuple(
        f"socialmind reproduce {name}{Way.KEPT if known[name][0].kept else ''}"
        for name in (result.study, *result.also)
    )


def results_in(folder: Path) -> tuple[Result, ...]:
    """The results of a topic.

    Args:
        folder: the topic's; its ``thesis.py`` holds them as ``results = (Result(…), …)``.

    Raises:
        ModelError: the file cannot be loaded, or does not hold results.
    """
    what = "the thesis's results of the topic"
    return declared_in(folder / THESIS_FILE, "results", Result, what)


def place_of(name: str) -> tuple[bool, int, int]:
    """Return where a result stands in the overview: figures before tables, by chapter and number.

    >>> sorted(["table 6.1", "figure 3.14", "figure 3.8", "figures 7.5, 7.6"], key=place_of)
    ['figure 3.8', 'figure 3.14', 'figures 7.5, 7.6', 'table 6.1']
    """
    kind, number = name.split()[:2]
    chapter, _, place = number.rstrip(",").partition(".")
    return kind.startswith("table"), int(chapter), int(place)


def rows_of(path: Path) -> list[dict[str, str]]:
    """Return the rows of a kept table.

    Raises:
        SocialmindError: it is not there.
    """
    if not path.is_file():
        raise SocialmindError(
            f"{path}: not there, and the overview is filled in from it; "
            f"`socialmind reproduce NAME --kept --out {path.parent}` makes it"
        )
    with path.open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def row_of(path: Path, **values: str) -> dict[str, str]:
    """Return the one row of a kept table that has these values.

    Raises:
        SocialmindError: there is none, or more than one.
    """
    rows = [row for row in rows_of(path) if all(row[name] == one for name, one in values.items())]
    if len(rows) != 1:
        raise SocialmindError(f"{path}: {len(rows)} rows with {values}; expected one")
    return rows[0]


def _entry(result: Result, folder: Path, known: Mapping[str, tuple[Study, Path]]) -> Entry:
    commands = commands_of(result, known)
    times = {row["command"]: float(row["seconds"]) for row in rows_of(folder.parent / TIMES_FILE)}
    measured = all(one in times for one in commands)
    parts = [in_words(sum(times[one] for one in commands)) if measured else "not measured"]
    hours = sum(_seconds(folder / "results" / "trainings" / one) for one in result.trainings)
    if hours:
        parts.append(f"trainings {in_words(hours)}")
    if result.unkept:
        parts.append(result.unkept)
    found, notes = tuple(result.found()), tuple(result.notes())
    return Entry(result, found, commands, "; ".join(parts), result.budget(), notes)


def _seconds(training: Path) -> float:
    """Return how long a kept training took, by its own record."""
    manifest = json.loads((training / "manifest.json").read_text("utf-8"))
    return float(manifest["timings"]["seconds"])


def in_words(seconds: float) -> str:
    """Return a time as somebody would say it.

    >>> in_words(42.3), in_words(400), in_words(5400)
    ('42 s', '7 min', '1.5 h')
    """
    if seconds < 100:
        return f"{seconds:.0f} s"
    return f"{seconds / 60:.0f} min" if seconds < 5400 else f"{seconds / 3600:.1f} h"


# Writing ------------------------------------------------------------------------------------------


def write_overview(out: Path) -> list[Path]:
    """Write the overview as Markdown and as a page of HTML.

    Args:
        out: the folder, made where it is missing.

    Returns:
        Both files.
    """
    found = entries()
    out.mkdir(parents=True, exist_ok=True)
    paths = [out / f"{PAGE}{suffix}" for suffix in (".md", ".html")]
    paths[0].write_text(as_markdown(found), "utf-8")
    paths[1].write_text(as_html(found), "utf-8")
    return paths


def counts_of(found: Sequence[Entry]) -> str:
    """Return how many rows and how many entries are of each verdict, in two sentences."""
    rows = [finding.verdict for entry in found for finding in entry.findings]
    parts = []
    for verdicts, what in ((rows, "rows"), ([entry.verdict for entry in found], "entries")):
        told = ", ".join(f"{verdicts.count(one)} {one}" for one in Verdict)
        parts.append(f"Of {len(verdicts)} {what}: {told}.")
    return " ".join(parts)


def as_markdown(found: Sequence[Entry]) -> str:
    """Return the overview as Markdown."""
    lines = [f"# {TITLE}", "", counts_of(found), "", *(f"{one}\n" for one in ABOUT)]
    lines += _markdown_table(_summary(found))
    for entry in found:
        lines += ["", f"## {_heading(entry)}", "", *(f"- {one}" for one in _facts(entry)), ""]
        lines += _markdown_table(_findings(entry))
    return "\n".join([*lines, ""])


def as_html(found: Sequence[Entry]) -> str:
    """Return the overview as one page of HTML."""
    sections = [html.section("All results", [html.table(_summary(found))], "all-results")]
    sections += [
        html.section(
            _heading(entry),
            [html.bullets(_facts(entry)), html.table(_findings(entry))],
            entry.result.name.replace(" ", "-"),
        )
        for entry in found
    ]
    plain = [one.replace("*", "") for one in (counts_of(found), *ABOUT)]
    return html.page(TITLE, [html.paragraph(one) for one in plain], sections)


def _heading(entry: Entry) -> str:
    name = entry.result.name
    return f"{name[0].upper()}{name[1:]}: {entry.result.shows}"


def _summary(found: Iterable[Entry]) -> list[dict[str, str]]:
    return [
        {
            "result": entry.result.name,
            "shows": entry.result.shows,
            "verdict": entry.counted,
            "command": _commands(entry),
            "time": entry.time,
        }
        for entry in found
    ]


def _commands(entry: Entry) -> str:
    return ", ".join(f"`{one}`" for one in entry.commands)


def _facts(entry: Entry) -> list[str]:
    budget = f"Budget: ours {entry.budget}; thesis {entry.result.thesis_budget}."
    return [
        f"{entry.counted[0].upper()}{entry.counted[1:]}.",
        f"{_commands(entry)}, {entry.time}.",
        *([budget] if entry.budget else []),
        *entry.notes,
    ]


def _findings(entry: Entry) -> list[dict[str, str]]:
    return [
        {
            "what": one.about,
            "thesis": one.thesis,
            "ours": one.ours,
            "verdict": one.verdict,
            "reason": one.reason,
        }
        for one in entry.findings
    ]


def _markdown_table(rows: Sequence[Mapping[str, str]]) -> list[str]:
    head = list(rows[0])
    lines = [f"| {' | '.join(head)} |", "|" + "---|" * len(head)]
    return lines + [
        f"| {' | '.join(cell.replace('|', chr(92) + '|') for cell in row.values())} |"
        for row in rows
    ]
