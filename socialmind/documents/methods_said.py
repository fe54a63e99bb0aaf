"""Sentences that the methods of runs and sweeps have in common."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from socialmind.documents.odd.entities import written
from socialmind.sources.folders import catalogue

if TYPE_CHECKING:
    from socialmind.model import Model

HASH_DIGITS = 12
"""Of a SHA-256 hash, as many as tell versions apart on a page."""
PACKAGES = {"python": "Python", "numpy": "NumPy", "numba": "Numba"}


def as_argument(model: Mapping[str, Any]) -> str:
    """Return what commands take for a model: its name if it ships with socialmind, else its path.

    Args:
        model: what a manifest says of it.
    """
    known = model["path"] is None or model["name"] in catalogue()
    return str(model["name"] if known else model["path"])


def interventions_said(records: Sequence[Mapping[str, Any]]) -> str:
    """Return the sentence of what was done to societies on their way, if anything was."""
    told = []
    for one in records:
        if "commands" in one:
            continue
        if "function" in one:
            digest = one["sources"]["sha256"][:HASH_DIGITS]
            what = [f"{one['function']} ({Path(one['file']).name}, SHA-256 {digest}…)"]
        elif "agent" in one:
            whose = f"{one['part']} of agent {one['agent']} of {one['population']}"
            what = [valued(whose, one["value"])]
        else:
            what = [valued(*each) for each in one["parameters"].items()]
            what += [
                f"the cognitive scheme {scheme['name']} of {owner} (SHA-256 "
                f"{scheme['sha256'][:HASH_DIGITS]}…)"
                for owner, scheme in one["schemes"].items()
            ]
        told.append(f"at tick {one['tick']:,} {listed(what)}")
    sentences = [f"Societies were changed on their way: {'; '.join(told)}."] if told else []
    return " ".join(sentences + _steering_said(records))


def _steering_said(records: Sequence[Mapping[str, Any]]) -> list[str]:
    """Return a sentence for each robot that somebody steered by hand."""
    sentences = []
    steered = [one for one in records if "commands" in one]
    for population, agent in dict.fromkeys((one["population"], one["agent"]) for one in steered):
        own = [one for one in steered if (one["population"], one["agent"]) == (population, agent)]
        sentences.append(
            f"Robot {agent} of {population} was steered by hand from tick {own[0]['tick']:,} on "
            f"({len(own):,} commands)."
        )
    return sentences


def opening(
    model: Mapping[str, Any],
    versions: Mapping[str, str],
    platforms: Sequence[Mapping[str, str]],
    model_class: type[Model] | None,
) -> str:
    """Return the sentence of the model, its version and the software."""
    sources = model.get("sources") or {}
    digest = sources.get("sha256") or model.get("source_sha256")
    hashed = f", whose source has the SHA-256 {digest[:HASH_DIGITS]}…," if digest else ""
    software = [f"{PACKAGES[one]} {versions[one]}" for one in PACKAGES if one in versions]
    software += [f"{one} {version}" for one, version in (sources.get("packages") or {}).items()]
    system = next((f"{one['system']}, {one['machine']}" for one in platforms), "")
    tools = "; ".join(filter(None, [", ".join(software), system]))
    described = ""
    if model_class is not None and (model_class.folder() / "ODD.md").is_file():
        described = " Its description after the ODD protocol (Grimm et al. 2020) is ODD.md."
    return (
        f"The model {model['name']}{hashed} was run with socialmind "
        f"{versions.get('socialmind', 'of an unknown version')} ({tools}).{described}"
    )


def valued(name: str, value: Any, unit: str = "") -> str:
    """Return a name with its value and unit."""
    return f"{name} = {written(value)}{f' {unit}' if unit else ''}"


def as_option(value: Any) -> str:
    """Return a value as options have it.

    >>> as_option(True), as_option(50.0), as_option(0.1)
    ('true', '50', '0.1')
    """
    if isinstance(value, float) and value.is_integer() and abs(value) < 1e15:
        return str(int(value))
    return str(value).lower() if isinstance(value, bool) else str(value)


def minds_used(
    schemes: Mapping[str, Mapping[str, str]], minds: Mapping[str, Mapping[str, str]]
) -> list[str]:
    """Return a sentence for each population with a scheme or a hierarchy of skills."""
    told = []
    for what, copies in (("cognitive scheme", schemes), ("hierarchy of skills", minds)):
        found: dict[str, list[str]] = {}
        for key, one in copies.items():  # a sweep may have several of a population
            name = f"{one['name']} (SHA-256 {one['sha256'][:HASH_DIGITS]}…)"
            found.setdefault(one.get("population", key), []).append(name)
        told += [f"The {what} of {owner} was {' or '.join(n)}." for owner, n in found.items()]
    return told


def ticks_said(number: int) -> str:
    """Return how often something was recorded, after `every`."""
    return "tick" if number == 1 else number_of_ticks(number)


def number_of_ticks(ticks: int) -> str:
    """Return a number of ticks in words."""
    return f"{ticks:,} tick{'s' if ticks != 1 else ''}"


def listed(words: Sequence[str]) -> str:
    """Return words as a sentence lists them.

    >>> listed(["a", "b", "c"])
    'a, b and c'
    """
    return " and ".join(filter(None, [", ".join(words[:-1]), *words[-1:]]))


def luck() -> str:
    """Return the sentence of where random numbers come from."""
    return (
        "Random numbers come from Philox4x32-10 (Salmon et al. 2011), keyed by the seed, the "
        "agent, the tick and the rule."
    )
