"""Imprinting: a network learns what a source does, on a closed loop without physics."""

import numpy as np
import pytest

from coglogo_py import CognitiveScheme, Cogniton, WeightedStochastic
from socialmind.errors import ModelError
from socialmind.mind import (
    CognitonScheme,
    Elman,
    Hierarchy,
    MindDescription,
    NeatGraph,
    Perceptron,
    Programmed,
    Recurrent,
    Skill,
)

torch = pytest.importorskip("torch")

from socialmind.learning.imprinting.controllers import controller_of  # noqa: E402
from socialmind.learning.imprinting.imprint import (  # noqa: E402
    first_population,
    imprint,
    imprint_in,
    record,
)
from socialmind.learning.imprinting.recording import Recording  # noqa: E402

EYES, MOTORS = ["SE:EyeL", "SE:EyeR"], ["MO:MotL", "MO:MotR"]


def seeker(function, genome=None):
    return Skill("Seek", EYES, MOTORS, function, genome)


@pytest.fixture(scope="module")
def imprinted(light):
    return imprint_in(
        light.episode,
        seeker(Programmed(light.cross_over)),
        seeker(Perceptron(layers=1)),
        seed=2,
        tolerance=0.01,
        epochs=60,
    )


def scores(light, source, episode=None, count=10):
    controller = controller_of(source, seeker(Perceptron()))
    found = []
    for seed in range(count):
        controller.reset()
        found.append((episode or light.episode)(controller, seed))
    return found


def test_the_target_does_as_well_on_episodes_that_nobody_saw(imprinted, light):
    assert imprinted.reached
    source = np.mean(scores(light, seeker(Programmed(light.cross_over))))
    target = np.mean(scores(light, imprinted.skill))
    drawn = np.mean(scores(light, seeker(Perceptron(layers=1), np.full(22, 0.1))))
    assert target > source - 0.03
    assert drawn < source - 0.1


def test_it_tells_how_it_went(imprinted):
    assert imprinted.rounds[-1].target >= imprinted.rounds[-1].source - 0.01
    assert all(one.target < one.source - 0.01 for one in imprinted.rounds[:-1])
    # Eight episodes of 120 ticks in each round.
    assert [one.records for one in imprinted.rounds] == [
        960 * number for number in range(1, len(imprinted.rounds) + 1)
    ]
    assert len(imprinted.recording) == imprinted.rounds[-1].records
    assert len(imprinted.losses) == 60
    assert imprinted.losses[-1] == imprinted.rounds[-1].loss


def test_all_of_it_follows_from_the_seed(light):
    def learned(seed):
        return imprint_in(
            light.episode,
            seeker(Programmed(light.cross_over)),
            seeker(Perceptron(layers=1)),
            seed,
            tolerance=0.0,
            rounds=2,
            episodes=1,
            scored=2,
            epochs=5,
        )

    torch.manual_seed(1)
    state = torch.get_rng_state()
    first, again, other = learned(1), learned(1), learned(3)
    assert torch.equal(torch.get_rng_state(), state)
    assert first.skill.genome.tolist() == again.skill.genome.tolist()
    assert first.rounds == again.rounds != other.rounds


def test_the_source_says_what_it_would_have_done_where_the_target_got_to(light):
    lost = seeker(Perceptron(layers=0), [0.0, 0.0, 0.3, 0.0, 0.0, 0.1])
    asked = []

    def watching(eyes):
        asked.append(list(eyes))
        return light.cross_over(*eyes)

    done = imprint_in(
        light.episode, watching, lost, 1, tolerance=0.0, rounds=2, episodes=2, scored=1, epochs=1
    )
    assert [one.records for one in done.rounds] == [2 * light.TICKS, 4 * light.TICKS]
    # Its own two episodes, one that is scored, the target's two and another that is scored.
    assert len(asked) == 6 * light.TICKS
    # In the target's episodes it was asked about what the target met, which hardly turns.
    met = asked[3 * light.TICKS : 5 * light.TICKS]
    assert done.recording.inputs.tolist()[2 * light.TICKS :] in ([], met)
    assert np.mean(met) < 0.9 * np.mean(asked[: 2 * light.TICKS])


def test_a_target_that_does_not_get_there_says_so(light):
    # So little training leaves it where it began: standing still.
    still = seeker(Perceptron(layers=0), np.zeros(6))
    done = imprint_in(
        light.episode,
        seeker(Programmed(light.cross_over)),
        still,
        seed=1,
        tolerance=0.05,
        rounds=3,
        episodes=1,
        epochs=1,
        rate=1e-9,
    )
    assert done.reached is False
    assert len(done.rounds) == 3
    leads = [one.target - one.source for one in done.rounds]
    assert max(leads) < -0.05
    assert len(done.recording) == done.rounds[leads.index(max(leads))].records


@pytest.mark.parametrize("function", [Elman(layers=1), Recurrent(layers=1)], ids=repr)
def test_a_source_that_remembers_needs_a_target_that_does(function, light):
    source = light.Remembering()
    recording = record(light.blinking, source, seeker(function), range(12))
    assert recording.lengths == (light.TICKS,) * 12
    with_memory = imprint(seeker(function), recording, seed=1, epochs=60)
    without = imprint(seeker(Perceptron(layers=1)), recording, seed=1, epochs=60)
    assert with_memory.losses[-1] < 0.2 * without.losses[-1]


@pytest.mark.parametrize("function", [Elman(layers=1), Recurrent(layers=1)], ids=repr)
def test_a_target_that_remembers_steers_by_a_light_that_blinks(function, light):
    numbers = {"seed": 2, "tolerance": 0.02, "rounds": 4, "epochs": 60}
    done = imprint_in(light.blinking, light.Remembering(), seeker(function), **numbers)
    assert done.reached
    assert len(done.rounds) > 1  # the source's own episodes alone did not do
    fresh = [
        np.mean(scores(light, one, light.blinking, 30)) for one in (light.Remembering(), done.skill)
    ]
    assert fresh[1] > fresh[0] - 0.04


def test_a_target_without_memory_does_not(light):
    numbers = {"seed": 2, "tolerance": 0.02, "rounds": 2, "epochs": 60}
    perceptron = seeker(Perceptron(layers=1))
    assert imprint_in(light.blinking, light.Remembering(), perceptron, **numbers).reached is False


def test_training_on_episodes_of_different_length_stops_where_each_ends(light):
    recording = Recording(
        [[0.2, 0.4], [0.6, 0.8], [0.3, 0.1]], [[0.1, 0.2], [0.3, 0.4], [0.5, 0.6]], (2, 1)
    )
    genome = np.linspace(-0.5, 0.5, Elman(layers=1).genome_size(2, 2))
    one = imprint(seeker(Elman(layers=1), genome), recording, seed=1, epochs=1, window=5)
    # The loss of the first epoch is over the three records, from the genome that was given.
    controller = controller_of(seeker(Elman(layers=1), genome), seeker(Elman()))
    squares = []
    for places in recording.episodes:
        controller.reset()
        for read, wanted in zip(recording.inputs[places], recording.outputs[places], strict=True):
            squares.append((controller(read) - wanted) ** 2)
    assert one.losses[0] == pytest.approx(np.mean(squares), rel=1e-9)


@pytest.mark.parametrize("function", [NeatGraph(), Perceptron(layers=0)], ids=repr)
def test_training_goes_on_from_the_genome_of_the_skill(function):
    genome = np.full(function.genome_size(2, 2), 0.25)
    recording = Recording([[0.1, 0.9], [0.8, 0.4]], [[0.2, 0.7], [0.9, 0.4]])
    done = imprint(seeker(function, genome), recording, seed=1, epochs=1, rate=1e-6)
    assert done.skill.genome == pytest.approx(genome, abs=3e-6)
    assert (done.skill.genome != genome).all()
    assert done.rounds == ()
    assert done.reached is None


def test_the_first_population_lies_around_the_imprint(imprinted):
    genome = imprinted.skill.genome
    population = first_population(imprinted, size=400, spread=0.2, seed=5)
    assert population.shape == (400, len(genome))
    assert (population[0] == genome).all()
    moved = population[1:] - genome
    assert moved.std() == pytest.approx(0.2, rel=0.05)
    assert abs(moved.mean()) < 0.01
    assert (population == first_population(imprinted, 400, 0.2, 5)).all()
    assert (first_population(imprinted, 3, 0.0, 5) == genome).all()


def test_sources_of_all_kinds_answer_alike(light):
    target = seeker(Perceptron(layers=0))
    crossing = [0.0, 1.0, 0.0, 1.0, 0.0, 0.0]
    swapped = seeker(Programmed(lambda left, right: (right, left)))
    mind = Hierarchy(MindDescription("agent", ["EyeR", "EyeL"], ["MotR", "MotL"], skills=[swapped]))
    sources = [
        swapped,
        mind,
        lambda eyes: eyes[::-1],
        seeker(Perceptron(layers=0), crossing),
    ]
    for source in sources:
        answered = controller_of(source, target)([0.25, 0.75])
        assert answered.tolist() == [0.75, 0.25]
    recordings = [record(light.episode, source, target, [3]) for source in sources]
    for recording in recordings[1:]:
        assert np.allclose(recording.outputs, recordings[0].outputs, rtol=0, atol=1e-12)


def test_a_hierarchy_is_reset_with_each_episode(light):
    memory = seeker(Elman(layers=1), np.full(Elman(layers=1).genome_size(2, 2), 0.1))
    mind = Hierarchy(MindDescription("agent", ["EyeL", "EyeR"], ["MotL", "MotR"], skills=[memory]))
    twice = record(light.episode, mind, seeker(Perceptron()), [4, 4])
    first, second = twice.episodes
    assert (twice.outputs[first] == twice.outputs[second]).all()
    assert twice.outputs[0].tolist() != twice.outputs[1].tolist()


def test_what_a_source_draws_follows_from_the_episode(light):
    scheme = CognitiveScheme(
        "moods",
        (
            Cogniton("Glad", start_value=1.0, influence={"Left": 1.0}, conditional=("Left",)),
            Cogniton("Sad", start_value=1.0, influence={"Right": 1.0}, conditional=("Right",)),
            Cogniton("Light", start_value=0.0, influence={"Left": 0.0}),
        ),
        decision_maker=WeightedStochastic(),
    )
    skills = [
        Skill("Top", ["SE:EyeL"], ["SK:Left", "SK:Right"],
              CognitonScheme(scheme, {"SE:EyeL": "Light"})),
        Skill("Left", ["SE:EyeL"], MOTORS, Programmed(lambda eye: (0.0, 1.0))),
        Skill("Right", ["SE:EyeL"], MOTORS, Programmed(lambda eye: (1.0, 0.0))),
    ]  # fmt: skip
    mind = Hierarchy(MindDescription("moody", ["EyeL", "EyeR"], ["MotL", "MotR"], skills=skills))
    target = seeker(Perceptron())
    found = record(light.episode, mind, target, [4, 5, 4])
    first, other, again = (found.outputs[one].tolist() for one in found.episodes)
    assert first == again != other
    drawn = [
        imprint_in(light.episode, mind, target, seed, 0.0, rounds=1, episodes=1, scored=1, epochs=1)
        for seed in (1, 2, 1)
    ]
    first, other, again = (one.recording.outputs.tolist() for one in drawn)
    assert first == again != other


def test_what_a_function_gives_is_held():
    controller = controller_of(lambda eyes: (2.0, -1.0), seeker(Perceptron()))
    assert controller([0.5, 0.5]).tolist() == [1.0, 0.0]


ONE = Recording([[0.5, 0.5]], [[0.5, 0.5]])


@pytest.mark.parametrize(
    ("made", "expected"),
    [
        (
            lambda: imprint(seeker(Programmed(lambda left, right: (left, right))), ONE, 1),
            "found the function <lambda> to be trained; expected a network, which has weights",
        ),
        (
            lambda: imprint(seeker(Perceptron()), Recording([[0.5]], [[0.5]]), 1),
            "found the skill 'Seek' to be trained on 1 inputs and 1 outputs; expected 2 and 2, as "
            "it has",
        ),
        (
            lambda: imprint(
                seeker(Perceptron()), Recording(np.zeros((0, 2)), np.zeros((0, 2))), 1
            ),
            "found the skill 'Seek' to be trained on an empty recording; expected one record or "
            "more",
        ),
        (
            lambda: imprint(seeker(Perceptron()), ONE, 1, epochs=0),
            "epochs: found 0; expected a whole number, 1 or more",
        ),
        (
            lambda: imprint(seeker(Perceptron()), ONE, 1, rate=0.0),
            "found rate=0.0 of training; expected a number above 0",
        ),
        (
            lambda: imprint(seeker(Perceptron(layers=0), np.zeros(6)), ONE, 1, rate=float("inf")),
            "found rate=inf of training; expected a number above 0",
        ),
        (
            lambda: imprint(seeker(Perceptron(layers=0), np.zeros(6)), ONE, 1, rate="fast"),
            "found rate='fast' of training; expected a number above 0",
        ),
        (
            lambda: imprint(seeker(Perceptron()), ONE, -1),
            "seed: found -1; expected a whole number, 0 … 2**64 - 1",
        ),
        (
            lambda: record(lambda steer, seed: 0.0, lambda eyes: eyes, seeker(Perceptron()), 8),
            "found seeds=8; expected several whole numbers, one for each episode",
        ),
        (
            lambda: controller_of(
                Skill("Seek", EYES, MOTORS, Programmed(lambda left, right: (left, right))),
                seeker(Perceptron()),
            )([0.1]),
            "found 1 inputs for the source; expected 2, as it has",
        ),
        (
            lambda: imprint(seeker(Perceptron(layers=0), np.zeros(6)), ONE, 1, rate=1e308),
            "training at the rate 1e+308 made weights that are no finite numbers; lower the rate",
        ),
        (
            lambda: imprint_in(lambda steer, seed: 0.0, lambda eyes: eyes, seeker(Perceptron()),
                               1, tolerance=-1.0),
            "found tolerance=-1.0 of imprinting; expected a number, 0 or more",
        ),
        (
            lambda: record(lambda steer, seed: float("nan"), lambda eyes: eyes,
                           seeker(Perceptron()), [7]),
            "found the score nan of the episode of seed 7; expected a finite number",
        ),
        (
            lambda: controller_of(lambda eyes: 0.5, seeker(Perceptron()))([0.1, 0.2]),
            "found 0.5 from the source; expected 2 finite numbers",
        ),
        (
            lambda: controller_of(
                Skill("Look", ["SE:Eye"], ["MO:Motor"], Perceptron()), seeker(Perceptron())
            ),
            "found the skill 'Look' of 1 inputs and 1 outputs as a source; expected 2 inputs and 2 "
            "outputs, as 'Seek' has",
        ),
        (
            lambda: controller_of("seek", seeker(Perceptron())),
            "found 'seek' as a source; expected a skill, a hierarchy or a function",
        ),
        (
            lambda: controller_of(
                Hierarchy(
                    MindDescription(
                        "agent", ["EyeL", "EyeR"], ["MotL", "MotR"], skills=[seeker(Perceptron())]
                    )
                ),
                Skill("Choose", EYES, ["SK:Seek"], Perceptron()),
            ),
            "found the skill 'Choose' with the output SK:Seek, which the hierarchy does not "
            "command; expected actuators of the hierarchy; take a function as the source",
        ),
        (
            lambda: first_population(imprint(seeker(NeatGraph()), ONE, 1, epochs=1), 2, -1.0, 1),
            "found spread=-1.0 of a first population; expected a number, 0 or more",
        ),
    ],
)  # fmt: skip
def test_refusals(made, expected):
    with pytest.raises(ModelError) as caught:
        made()
    assert str(caught.value) == expected
