"""The schedule of a model: which rules run in a tick, for whom and in what order."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from socialmind.errors import ModelError
from socialmind.language.shape import PhaseShape
from socialmind.society.population import Population

Rule = Callable[..., Any]


class PhaseDeclaration:
    """One entry of a model's schedule; `each` and `once` make them."""

    def __init__(self, rule: Rule, population: Population | None, shuffled: bool) -> None:
        self.rule = rule
        self.population = population
        self.shuffled = shuffled

    @property
    def shape(self) -> PhaseShape:
        """The phase, with its population by name."""
        name = None if self.population is None else self.population.name
        return PhaseShape(self.rule, name, self.shuffled)

    def __str__(self) -> str:
        if self.population is None:
            return f"once: {self.rule.__name__}"
        order = "random order" if self.shuffled else "order of birth"
        return f"each of {self.population.name}, {order}: {self.rule.__name__}"


def each(population: Population, rule: Rule, *, shuffled: bool = True) -> PhaseDeclaration:
    """Declare a phase in which each agent of a population follows a rule.

    Args:
        population: the population, as declared in the same class.
        rule: a plain function `rule(agent, model, rng)`; it may leave out `model` and `rng`.
        shuffled: a fresh random order each tick (NetLogo's), or the order of birth.
    """
    if not isinstance(population, Population):
        raise ModelError(
            f"each({population!r}, …)", "a population of the class", "write each(humans, rule)"
        )
    return PhaseDeclaration(rule, population, shuffled)


def once(rule: Rule) -> PhaseDeclaration:
    """Declare a phase in which a rule runs once a tick.

    Args:
        rule: a plain function `rule(model, rng)`; it may leave out `rng`.
    """
    return PhaseDeclaration(rule, None, False)
