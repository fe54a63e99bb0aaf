"""Vehicles of Braitenberg: one tick by hand, and what each wiring makes of light."""

import math

import numpy as np
import pytest

from socialmind.catalogue import load_model

SEEDS = range(6)


@pytest.fixture(params=[True, False], ids=["compiled", "interpreted"])
def vehicle(request):
    """A vehicle at (0, 0) that looks north, with a light 6 patches to the east: the reach."""

    def made(crossed, inhibiting, heading=0.0, light=(6.0, 0.0)):
        society = load_model("braitenberg")(
            1, compiled=request.param, n_vehicles=1, n_lights=1, full_speed=0.5, largest_turn=40.0
        )
        one = society.vehicles[0]
        one.x, one.y, one.heading = 0.0, 0.0, heading
        one.crossed, one.inhibiting = crossed, inhibiting
        society.lights[0].x, society.lights[0].y = light
        society.advance(1)
        return society.vehicles[0]

    return made


# A light of brightness 1/2, at 90° to the right: 135° past the left eye's middle, 45° past the
# right one's.
FAINT = 0.5 * (1 - math.sqrt(0.5)) / 2
BRIGHT = 0.5 * (1 + math.sqrt(0.5)) / 2


@pytest.mark.parametrize(
    ("crossed", "inhibiting", "left", "right"),
    [
        (False, False, FAINT, BRIGHT),
        (True, False, BRIGHT, FAINT),
        (False, True, 1 - FAINT, 1 - BRIGHT),
        (True, True, 1 - BRIGHT, 1 - FAINT),
    ],
    ids=["fear", "aggression", "love", "exploration"],
)
def test_one_tick_by_hand(vehicle, crossed, inhibiting, left, right):
    one = vehicle(crossed, inhibiting)
    assert (one.left_eye, one.right_eye) == pytest.approx((FAINT, BRIGHT), abs=1e-12)
    assert (one.left_wheel, one.right_wheel) == pytest.approx((left, right), abs=1e-12)
    heading = 40.0 * (left - right)
    assert one.heading == pytest.approx(heading % 360)
    speed = 0.5 * (left + right) / 2
    assert one.x == pytest.approx(speed * math.sin(math.radians(heading)))
    assert one.y == pytest.approx(speed * math.cos(math.radians(heading)))


def test_a_light_straight_ahead_turns_nobody(vehicle):
    for crossed in (False, True):
        one = vehicle(crossed, False, heading=90.0)
        assert one.heading == pytest.approx(90.0)
        assert one.x > 0.2


def test_an_eye_holds_no_more_than_full_light(vehicle):
    one = vehicle(True, False, light=(0.0, 0.0))
    assert 0 < one.left_wheel <= 1
    assert one.left_wheel == one.right_wheel


def late_distances(seed, **parameters):
    """Return the mean distances of seekers and avoiders at the start, and late in a run."""
    society = load_model("braitenberg")(seed, **parameters)

    def both():
        series = society.series()
        return series["seekers_distance"], series["avoiders_distance"]

    start = both()
    society.advance(400)
    late = []
    for _ in range(10):
        society.advance(10)
        late.append(both())
    return start, np.mean(late, axis=0)


@pytest.mark.parametrize("inhibiting", [0.0, 1.0])
@pytest.mark.parametrize("seed", SEEDS)
def test_seekers_end_near_lights_and_avoiders_far_from_them(seed, inhibiting):
    (seekers, avoiders), (near, far) = late_distances(seed, share_inhibiting=inhibiting)
    assert near < 0.5 * seekers
    assert far > 1.3 * avoiders
    assert near < 4.0 < 11.0 < far


def test_who_loves_light_rests_and_who_is_aggressive_does_not():
    speeds = {}
    for inhibiting in (0.0, 1.0):
        society = load_model("braitenberg")(2, share_fleeing=0.0, share_inhibiting=inhibiting)
        society.advance(500)
        speeds[inhibiting] = society.series()["seekers_speed"]
    assert speeds[1.0] < 0.03
    assert speeds[0.0] > 0.1


def test_kinds_follow_the_shares():
    model = load_model("braitenberg")
    assert set(model(3, share_fleeing=1.0).agents()["kind"]) == {"fear"}
    assert set(model(3, share_fleeing=0.0).agents()["kind"]) == {"aggression"}
    inhibiting = {"share_inhibiting": 1.0}
    assert set(model(3, share_fleeing=1.0, **inhibiting).agents()["kind"]) == {"exploration"}
    assert set(model(3, share_fleeing=0.0, **inhibiting).agents()["kind"]) == {"love"}
    half = model(3, n_vehicles=400).series()
    assert 150 < half["avoiders"] < 250
    assert half["seekers"] + half["avoiders"] == 400


def test_a_run_without_a_kind_has_no_distance_of_it():
    assert math.isnan(load_model("braitenberg")(1, share_fleeing=1.0).series()["seekers_distance"])
