"""Robots that find their roles: the world, its market and shocks, and what is measured of it."""

import warnings
from types import SimpleNamespace

import numpy as np
import pytest
from matplotlib.text import Text

from socialmind.catalogue import load_figures, load_model
from socialmind.experiments import Run, run
from socialmind.sources.folders import model_folder
from socialmind.sources.loading import load_file

FOLDER = model_folder("foraging_roles")
PAYOFF = load_file(FOLDER / "payoff.py")
ForagingRoles = load_model("foraging_roles")
FORAGE_ROLE = "ForageRole"
STAY = np.zeros(39)
STAY[21] = 1.0  # the bias of the influence on the role as it is


def staying():
    """The mind that ships, but its robots never change roles."""
    from socialmind.mind import MindDescription

    mind = MindDescription.load(FOLDER / "mind")
    return mind.with_modules(skills=[mind.skill(FORAGE_ROLE).changed(genome=STAY)])


def test_payoffs_tell_what_is_scarce():
    # 20 B and 10 A are as wanted; of 30 objects 10 A are plenty, at a price of 2 B.
    assert PAYOFF.scarcity_of_a(20.0, 10.0, 2 / 3) == pytest.approx(0.0, abs=1e-12)
    assert PAYOFF.scarcity_of_a(30.0, 0.0, 2 / 3) == pytest.approx(1.5)
    assert PAYOFF.scarcity_of_a(0.0, 30.0, 2 / 3) == pytest.approx(-3.0)
    assert PAYOFF.worth(0.0) == 0.5
    assert PAYOFF.worth(1.0) == pytest.approx(0.5 + PAYOFF.PAYOFF)


@pytest.mark.parametrize(("wanted", "b"), [(0.2, 3.0), (0.5, 9.0), (0.75, 1.0)])
def test_kinds_are_treated_alike(wanted, b):
    scarce = PAYOFF.scarcity_of_a(b, 10.0 - b, wanted)
    assert scarce == pytest.approx((b / 10 - wanted) / (wanted * (1 - wanted)))
    assert PAYOFF.scarcity_of_a(10.0 - b, b, 1 - wanted) == pytest.approx(-scarce)


def test_an_object_is_counted_by_its_kind_and_worth_more_where_that_is_scarce():
    market = SimpleNamespace(staple=5.0, ware=4.0, perception=0.0)
    model = SimpleNamespace(markets=[market], wanted=0.5, decay=0.25)
    robot = SimpleNamespace(load=2, payoff=0.0, paid=False, earned=0.0)
    PAYOFF.pay(robot, model)
    # A B makes six of ten: A is scarcer by 0.1 / (0.5 · 0.5), and B is worth less by 0.15 times it.
    assert (market.staple, market.ware) == (6.0, 4.0)
    assert (market.perception, robot.payoff) == pytest.approx((0.4, 0.44))
    robot.load = 1
    PAYOFF.pay(robot, model)
    assert (market.staple, market.ware) == (6.0, 5.0)
    assert robot.payoff == pytest.approx(0.5 + 0.15 * (6 / 11 - 0.5) / 0.25)
    assert (robot.paid, robot.earned) == (True, 2.0)
    PAYOFF.forget(market, model)
    assert (market.staple, market.ware) == (4.5, 3.75)


def test_the_market_opens_with_what_is_wanted():
    model = ForagingRoles(seed=1, foragers=4, wanted_b=0.25, hierarchy=staying())
    # Three objects a robot, a quarter of them B.
    assert (model.markets.staple.tolist(), model.markets.ware.tolist()) == ([3.0], [9.0])


@pytest.mark.parametrize(("start", "in_b"), [(0, 0), (1, 9), (2, 9)])
def test_roles_begin_as_the_start_says(start, in_b):
    model = ForagingRoles(seed=1, start=start, hierarchy=staying())
    model.advance(3)
    assert model.in_b == in_b
    assert len(set(model.robots.role.tolist())) == 1


def test_random_starts_differ_and_any_start_is_drawn_for_each_world():
    model = ForagingRoles(seed=1, start=3, hierarchy=staying())
    assert len(set(model.robots.role.tolist())) == 9
    drawn = {ForagingRoles(seed=seed, hierarchy=staying()).began_as for seed in range(12)}
    assert drawn == {0, 1, 2, 3}


@pytest.mark.parametrize("foragers", [1, 9, 36])
def test_there_are_slightly_more_objects_of_each_kind_than_robots(foragers):
    model = ForagingRoles(seed=2, foragers=foragers, hierarchy=staying())
    assert len(model.objects_a) == len(model.objects_b) == foragers + 3
    assert (model.objects_a.x <= -35).all()
    assert (model.objects_b.x >= 35).all()
    assert len(model.robots) == foragers


def test_robots_bring_what_their_roles_say_and_are_paid():
    model = ForagingRoles(seed=3, start=0, foragers=4, hierarchy=staying())
    staple = model.markets.staple[0]
    while model.robots.delivered_a.sum() == 0 and model.tick < 3000:
        model.advance(1)
    robots = model.robots
    paid = robots.paid.astype(bool)
    assert paid.sum() == robots.delivered_a.sum() == 1
    assert robots.delivered_b.sum() == 0
    market = model.markets
    # The last decay came after the delivery, and took the same share of both counts.
    scarcity = PAYOFF.scarcity_of_a(market.staple[0], market.ware[0], model.wanted)
    assert robots.payoff[paid][0] == pytest.approx(0.5 + PAYOFF.PAYOFF * scarcity)
    assert market.staple[0] == pytest.approx(staple * (1 - model.decay) ** model.tick)
    model.advance(1)
    assert not model.robots.paid.any()
    assert model.robots.score.sum() == 1


def test_a_mind_thinks_of_its_role_after_a_delivery_alone():
    model = ForagingRoles(seed=3, start=1, foragers=2, decay=0.0, wanted_b=0.1)
    before = model.robots.role.copy()
    deliveries = 0
    while deliveries < 3 and model.tick < 6000:
        model.advance(1)
        deliveries = int(model.robots.delivered_b.sum() + model.robots.delivered_a.sum())
        if deliveries == 0:
            assert (model.robots.role == before).all()
    assert deliveries == 3


def test_robots_that_are_stuck_are_rescued_and_objects_astray_put_elsewhere():
    model = ForagingRoles(seed=3, compiled=False, foragers=2, patience=8, hierarchy=staying())
    ball = model.objects_a[0]
    ball.x += 2.5
    model.advance(8)
    assert ball.x == ball.home_x
    assert model.robots.rescues.tolist() == [0, 0]
    model.advance(1)
    assert model.robots.rescues.tolist() == [1, 1]
    assert np.hypot(model.robots.x, model.robots.y) == pytest.approx(2.5)
    assert model.robots.since.tolist() == [0, 0]


# Shocks -----------------------------------------------------------------------------------------


def test_the_wanted_ratio_is_turned_round():
    model = ForagingRoles(seed=1, reverse_at=5, hierarchy=staying())
    model.advance(5)
    assert model.wanted == pytest.approx(2 / 3)
    model.advance(1)
    assert model.wanted == pytest.approx(1 / 3)
    assert model.began_at == 6  # the first tick's record that shows it


def test_what_is_wanted_can_be_set_at_any_time():
    model = ForagingRoles(seed=1, start=1, hierarchy=staying())
    model.advance(2)
    assert model.off == pytest.approx(3.0)
    model.wanted = 0.5
    model.advance(2)
    assert model.off == pytest.approx(4.5)


@pytest.mark.parametrize("role", [0, 1])
@pytest.mark.parametrize("shift", [3, 7])
def test_robots_are_taken_away_of_one_role_as_long_as_it_has_any(role, shift):
    given = {"removed_role": role, "shift": shift}
    model = ForagingRoles(seed=1, start=2, remove_at=5, **given, hierarchy=staying())
    model.advance(4)
    before = {0: 9 - model.in_b, 1: model.in_b}
    model.advance(3)
    after = {0: len(model.robots) - model.in_b, 1: model.in_b}
    others = max(shift - before[role], 0)
    assert after == {role: max(before[role] - shift, 0), 1 - role: before[1 - role] - others}
    assert sum(after.values()) == 9 - shift


def test_robots_are_added_and_work():
    model = ForagingRoles(seed=1, start=0, add_at=5, hierarchy=staying())
    model.advance(10)
    assert len(model.robots) == 12
    place = model.robots.x[-3:].copy(), model.robots.y[-3:].copy()
    assert (np.hypot(*place) < 5).all()
    model.advance(200)
    assert (np.hypot(model.robots.x[-3:] - place[0], model.robots.y[-3:] - place[1]) > 3).all()


# The learned mind, and its figures ----------------------------------------------------------------


def test_the_learned_mind_divides_the_work_of_robots_that_all_fetch_a():
    model = ForagingRoles(seed=4, start=0)
    model.advance(30_000)
    assert model.off <= 2.0
    assert len(set(model.robots.role.tolist())) > 3


@pytest.mark.parametrize("ticks", [300, 1])
def test_figures_are_drawn_at_journal_width_and_legible(ticks, tmp_path):
    recorded = Run(run(ForagingRoles, ticks, 2, every=50, agents_every=50, out=tmp_path / "run"))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        figures = load_figures(FOLDER).draw(recorded)
        for name, figure in figures.items():
            figure.savefig(tmp_path / f"{name}.pdf")
    assert list(figures) == ["roles", "steps"]
    for figure in figures.values():
        assert 84.9 <= figure.get_size_inches()[0] * 25.4 <= 180.1
        texts = [text for text in figure.findobj(Text) if text.get_text().strip()]
        assert min(text.get_fontsize() for text in texts) >= 7
    shown = [axes for axes in figures["steps"].axes if axes.get_visible()]
    titles = [axes.get_title(loc="left") for axes in shown]
    assert all(title.endswith(" B") for title in titles)
