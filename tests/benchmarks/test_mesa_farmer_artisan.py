"""The Mesa program that the benchmarks measure against plays by the rules."""

from __future__ import annotations

import importlib.util
from pathlib import Path
from types import ModuleType

import pytest

PATH = Path(__file__).parents[2] / "benchmarks" / "mesa_farmer_artisan.py"


@pytest.fixture(scope="module")
def program() -> ModuleType:
    spec = importlib.util.spec_from_file_location("mesa_farmer_artisan", PATH)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def after(program: ModuleType, ticks: int, seed: int = 1) -> object:
    society = program.Society(rng=seed)
    for _ in range(ticks):
        society.step()
    return society


def test_trade_keeps_the_worth_of_the_village(program: ModuleType) -> None:
    society = after(program, 2000)
    worth = society.wheat + society.tools * program.TOOL_PRICE
    assert worth == pytest.approx(100 * program.TOOL_PRICE)
    assert society.tools != 50  # somebody traded


def test_everybody_gets_land_of_their_own(program: ModuleType) -> None:
    society = after(program, 2000)
    lands = [(human.land.x, human.land.y) for human in society.agents]
    assert len(set(lands)) == 25
    assert not any(abs(x) <= 1 and abs(y) <= 1 for x, y in lands)  # the village and its rim


def test_success_in_trade_makes_the_specialist(program: ModuleType) -> None:
    human = next(iter(program.Society(rng=0).agents))
    human.feed_back(program.TRADE_TOOLS_FOR_WHEAT, 10.0)
    assert human.cognitons[program.ARTISAN] == pytest.approx(0.5)
    assert human.cognitons[program.FARMER] == pytest.approx(-0.5)


def test_choices_follow_the_biased_shares(program: ModuleType) -> None:
    human = next(iter(program.Society(rng=0).agents))
    # Weights −4, closed, 2 and 1: shares of 1, 7 and 6 of 14, by rank 7, 6, 1.
    human.cognitons = [0.0] * 7
    human.cognitons[program.WHEAT_STOCK] = -200.0
    human.cognitons[program.FARMER] = 0.4
    human.cognitons[program.ARTISAN] = 0.2
    draws = 20_000
    chosen = [human.choose_plan() for _ in range(draws)]
    best = (7 / 14) ** (1 / 2.6)
    second = (13 / 14) ** (1 / 2.6) - best
    assert chosen.count(program.TRADE_TOOLS_FOR_WHEAT) == 0
    assert chosen.count(program.GROW_WHEAT) / draws == pytest.approx(best, abs=0.02)
    assert chosen.count(program.PRODUCE_TOOLS) / draws == pytest.approx(second, abs=0.02)


def test_a_seed_gives_one_run(program: ModuleType) -> None:
    def state(seed: int) -> list[tuple[float, float, float]]:
        society = after(program, 300, seed)
        return sorted((human.x, human.wheat, human.tools) for human in society.agents)

    assert state(3) == state(3)
    assert state(3) != state(4)
