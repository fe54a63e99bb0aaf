"""Phases: what is no rule is refused where it is written."""

import pytest

from socialmind import Agent, Model, ModelError, Network, Population, each, once, parameter


class Cow(Agent):
    pass


def graze(cow):
    pass


FILE = __file__


def test_a_name_of_the_class_that_hides_a_rule_is_named_with_its_line():
    def as_parameter():
        class Herd(Model):
            graze: float = parameter(1.0)
            cows = Population(Cow, 2)
            schedule = (each(cows, graze),)

    def as_variable():
        class Herd(Model):
            graze: float = 1.0
            schedule = (once(graze),)

    def as_population():
        class Herd(Model):
            graze = Population(Cow, 2)
            schedule = (each(graze, graze),)

    def as_network():
        class Herd(Model):
            cows = Population(Cow, 2)
            graze = Network(cows)
            setup = (each(cows, graze),)

    for made, found, lines in (
        (as_parameter, "a parameter as a rule in each", 4),
        (as_variable, "1.0 as a rule in once", 3),
        (as_population, "a population as a rule in each", 3),
        (as_network, "a network as a rule in each", 4),
    ):
        line = made.__code__.co_firstlineno + lines
        with pytest.raises(ModelError) as caught:
            made()
        assert str(caught.value).startswith(f"{FILE}:{line}: found {found}")
        assert "call nothing of the class like it" in str(caught.value)


def test_a_text_in_place_of_a_population_is_refused_with_its_line():
    with pytest.raises(ModelError, match=r"test_phases.py:\d+: found each\('cows', …\)"):
        each("cows", graze)
