"""A lesson being taught: the worlds, the curve, budgets, the finals, and what is refused."""

import numpy as np
import pytest

from socialmind.errors import ModelError
from socialmind.learning.episodes.evaluation import COMPILED, Scores
from socialmind.learning.episodes.evaluators import Evaluators
from socialmind.learning.lessons.keys import FINAL, seeds_for
from socialmind.learning.training.teaching import COLUMNS, VALIDATED, Teaching, check_fits
from socialmind.mind import Programmed, Skill
from socialmind.work.workers import Threads

KEY = (7, 1, "Go", 1)


class Noting:
    """Evaluates in one go, and keeps what it was asked."""

    def __init__(self):
        self.seeds, self.genomes = [], []

    def evaluate(self, evaluation, genomes, seeds, stop=lambda: False):
        self.seeds.append(tuple(seeds))
        self.genomes.append(np.array(genomes))
        outcome = evaluation.episodes().run(genomes, seeds)
        return Scores(outcome.score, outcome.ticks)


def still():
    """Stand still."""
    return 0.5


STILL = Skill("Go", [], ["MO:X"], Programmed(still))
ASIDE = STILL.changed(name="Aside")


def stop():
    return False


def taught(lesson, mind, workers=None):
    workers = workers or Noting()
    teaching = Teaching(lesson, mind, KEY, COMPILED)
    while not teaching.over:
        teaching.advance(workers, stop)
    return teaching, teaching.result(workers, stop), workers


def test_it_learns_and_the_curve_says_so(lesson, robot):
    _, result, _ = taught(lesson("Go", luck=0.0, generations=60), robot)
    rows = dict(zip(COLUMNS, result.rows.T, strict=True))
    assert result.score > -0.1 > rows["best"][0]
    assert (rows["generation"] == np.arange(1, 61)).all()
    assert (rows["best"] >= rows["mean"]).all()
    assert (rows["best_so_far"] == np.maximum.accumulate(rows["best"])).all()
    assert (np.diff(rows["ticks"]) > 0).all()
    assert result.best.score == rows["best"].max()


def test_mean_and_deviation_are_those_of_the_individuals_means_over_worlds(lesson, robot):
    _, result, workers = taught(lesson("Go", generations=1), robot)
    worlds = [0.5 + 0.1 * np.random.default_rng(seed).normal() for seed in workers.seeds[0]]
    away = [[((genome - one) ** 2).sum() for one in worlds] for genome in workers.genomes[0]]
    scores = -np.mean(away, axis=1)
    assert result.rows[0][1:4] == pytest.approx([scores.max(), scores.mean(), scores.std()])


def test_worlds_are_fresh_or_fixed_and_hang_on_the_key_alone(lesson, robot):
    _, _, fresh = taught(lesson("Go"), robot)
    assert len({one for seeds in fresh.seeds for one in seeds}) == 6 * 2 + 5
    _, _, again = taught(lesson("Go", generations=3, settings={"population": 30}), robot)
    assert again.seeds[:3] == fresh.seeds[:3]
    _, _, fixed = taught(lesson("Go", worlds="fixed"), robot)
    assert len(set(fixed.seeds[:6])) == 1
    assert fixed.seeds[6] == fresh.seeds[6]


def test_validation_judges_the_best_of_each_generation_on_the_same_worlds_and_changes_nothing_else(
    lesson, robot
):
    plain, without, _ = taught(lesson("Go"), robot)
    teaching, result, workers = taught(lesson("Go", validation=8), robot)
    assert (result.rows[:, :6] == without.rows[:, :6]).all()
    assert (result.winner.genome == without.winner.genome).all()
    assert (teaching.ticks, result.ticks) == (plain.ticks, without.ticks)
    asked = [(seeds, n) for n, seeds in enumerate(workers.seeds) if len(seeds) == 8]
    assert len(asked) == 6
    assert len({seeds for seeds, _ in asked}) == 1
    validated = dict(zip([*COLUMNS, VALIDATED], result.rows.T, strict=True))[VALIDATED]
    for score, (seeds, place) in zip(validated, asked, strict=True):
        (best,) = workers.genomes[place]
        assert (workers.genomes[place - 1] == best).all(axis=1).any()
        worlds = [0.5 + 0.1 * np.random.default_rng(seed).normal() for seed in seeds]
        assert score == pytest.approx(-np.mean([((best - one) ** 2).sum() for one in worlds]))
    again = Teaching(lesson("Go", validation=8), robot, KEY, COMPILED, resumed=True)
    again.restore(teaching.state())
    assert again.rows == teaching.rows


def test_the_budget_ends_it_after_the_generation_in_which_it_is_used_up(lesson, robot):
    one, _, _ = taught(lesson("Go", generations=1), robot)
    short, result, _ = taught(lesson("Go", budget=one.ticks + 1), robot)
    assert short.generation == 2
    assert result.ticks > short.ticks
    exact, _, _ = taught(lesson("Go", budget=one.ticks), robot)
    assert exact.generation == 1


def test_the_winner_is_the_best_of_the_finals_on_common_worlds(lesson, robot):
    teaching, result, workers = taught(lesson("Go", luck=1.0, finalists=4), robot)
    assert len(workers.genomes[-1]) == 4
    # Worlds of their own, which stay the same, so that kept trainings go on to the same winner.
    assert list(workers.seeds[-1]) == seeds_for(5, FINAL, *KEY)
    assert result.score == max(score for _, score in result.finalists)
    outcome = teaching.evaluation.episodes().run(result.winner.genome[None], workers.seeds[-1])
    assert result.score == pytest.approx(outcome.score.mean())
    assert result.deviation == pytest.approx(outcome.score.std())
    # The highest of all generations was lucky, and so is judged once more.
    assert any((one == result.best.genome).all() for one in workers.genomes[-1])


def test_what_is_known_is_where_it_begins_and_is_kept_unless_it_is_surpassed(lesson, robot):
    known = np.full(6, 0.5)
    mind = robot.with_modules(skills=[robot.skill("Go").changed(genome=known)])
    again = lesson("Go", luck=0.0, start="known", spread=0.01, generations=2)
    teaching, result, workers = taught(again, mind)
    assert (workers.genomes[0][0] == known).all()
    assert 0.005 < (workers.genomes[0][1:] - known).std() < 0.02
    assert (result.winner.generation, result.score) == (1, 0.0)
    assert (teaching.learned(result.winner)[0].genome == known).all()
    _, _, anew = taught(lesson("Go", generations=1), mind)
    assert np.abs(anew.genomes[0] - known).max() > 0.5


def test_first_individuals_stand_at_the_head(lesson, robot):
    given = np.arange(12.0).reshape(2, 6) / 12
    _, _, workers = taught(lesson("Go", first=given, generations=1), robot)
    assert (workers.genomes[0][:2] == given).all()
    made = lesson("Go", first=lambda skill, seed: np.full((3, skill.genome_size), seed / 2**63))
    _, _, workers = taught(made, robot)
    assert 0 < workers.genomes[0][2, 0] < 1


def test_it_is_begun_anew_by_other_draws_and_the_best_of_all_finals_counts(lesson, robot):
    one, alone, _ = taught(lesson("Go", luck=0.5), robot)
    teaching, result, workers = taught(lesson("Go", luck=0.5, starts=3), robot)
    assert teaching.generation == 3 * 6
    assert (result.rows[:6, :-1] == alone.rows[:, :-1]).all()
    assert (result.rows[:, 0] == np.arange(1, 19)).all()
    finals = [n for n, seeds in enumerate(workers.seeds) if len(seeds) == 5]
    assert finals == [6, 13, 20]
    assert len({workers.seeds[n] for n in finals}) == 1
    judged_on = {seed for n, seeds in enumerate(workers.seeds) if n not in finals for seed in seeds}
    assert len(judged_on) == 3 * 6 * 2
    assert result.score == max(score for _, score in result.finalists)
    assert dict(result.finalists[: len(alone.finalists)]) == dict(alone.finalists)
    assert {(generation - 1) // 6 for generation, _ in result.finalists} == {0, 1, 2}
    assert result.ticks == teaching.ticks + 3 * (alone.ticks - one.ticks)


def test_there_is_no_other_start_when_one_is_good_enough(lesson, robot):
    _, alone, _ = taught(lesson("Go"), robot)
    _, content, _ = taught(lesson("Go", starts=3, enough=alone.score), robot)
    assert (len(content.rows), content.score, content.ticks) == (6, alone.score, alone.ticks)
    _, ambitious, _ = taught(lesson("Go", starts=3, enough=0.1), robot)
    assert len(ambitious.rows) == 18


def test_a_budget_that_cuts_a_start_short_lets_it_be_judged_all_the_same(lesson, robot):
    one, _, _ = taught(lesson("Go"), robot)
    cut, result, _ = taught(lesson("Go", starts=3, budget=one.ticks + 1), robot)
    assert cut.generation == 7
    assert result.finalists[-1][0] == 7


def test_several_skills_learn_as_one(lesson, robot):
    mind = robot.with_modules(skills=[robot.skill("Top").changed(genome=np.ones(4))])
    teaching, result, _ = taught(lesson("Both", skill=("Turn", "Go"), master="Top"), mind)
    turn, go = teaching.learned(result.winner)
    assert (turn.name, go.name) == ("Turn", "Go")
    assert np.concatenate([turn.genome, go.genome]).tolist() == result.winner.genome.tolist()


def test_graphs_that_grow(lesson, robot):
    pytest.importorskip("neat")
    go = lesson("Go", optimiser="NEAT", settings={"population": 10})
    teaching, result, _ = taught(go, robot, Evaluators(Threads(2)))
    (skill,) = teaching.learned(result.winner)
    assert skill.function == result.winner.graph
    assert skill.genome_size == len(result.winner.genome)


@pytest.mark.parametrize("optimiser", ["GENETIC", "NEAT"])
@pytest.mark.parametrize(("after", "starts"), [(0, 1), (3, 1), (6, 1), (6, 2), (9, 2), (12, 2)])
def test_restored_it_goes_on_as_if_undisturbed(lesson, robot, tmp_path, optimiser, after, starts):
    if optimiser == "NEAT":
        pytest.importorskip("neat")
    one = lesson("Go", optimiser=optimiser, starts=starts)
    workers = Evaluators(Threads(1))
    _, undisturbed, _ = taught(one, robot, workers)
    first = Teaching(one, robot, KEY, COMPILED)
    for _ in range(after):
        first.advance(workers, stop)
    np.savez(tmp_path / "state.npz", **first.state())
    second = Teaching(one, robot, KEY, COMPILED, resumed=True)
    with np.load(tmp_path / "state.npz") as state:
        second.restore(dict(state))
    while not second.over:
        second.advance(workers, stop)
    result = second.result(workers, stop)
    assert (result.rows[:, :-1] == undisturbed.rows[:, :-1]).all()
    assert result.winner.same(undisturbed.winner)
    assert result.best.same(undisturbed.best)
    assert result.finalists == undisturbed.finalists
    assert result.ticks == undisturbed.ticks


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"name": "Fly"}, "the skill 'Fly', which the mind 'robot' has not"),
        ({"name": "Go", "master": "Topp"}, "did you mean 'Top'?"),
        ({"name": "Go", "master": "Turn"}, "under the master 'Turn', which does not influence it"),
        ({"name": "Top"}, "the skill 'Go' below 'Top', which has no weights yet"),
        ({"name": "Go", "start": "known"}, "start='known' of the skill 'Go', which has no weights"),
        ({"name": "Go", "first": np.zeros((3, 2))}, "shape (3, 2); expected (k, 6)"),
        ({"name": "X", "skill": ("Go", "Turn"), "master": "Top", "optimiser": "NEAT",
          "settings": {}}, "of 2 skills by NEAT; expected one skill"),
        ({"name": "Top", "stand_ins": (ASIDE,)}, "a stand-in for 'Aside'; expected stand-ins for"),
        ({"name": "Go", "stand_ins": (STILL,)}, "a stand-in for 'Go'; expected stand-ins for"),
        ({"name": "Top", "stand_ins": (STILL,)}, "the skill 'Turn' below 'Top', which has no w"),
    ],
)  # fmt: skip
def test_lessons_that_do_not_fit_the_mind_are_refused(lesson, robot, changes, said):
    with pytest.raises(ModelError) as raised:
        check_fits(lesson(**changes), robot, [])
    assert said in str(raised.value)
    assert f"the lesson {changes['name']!r}" in str(raised.value)


def test_a_skill_learns_on_stand_ins_and_goes_on_without(lesson, robot):
    stand_ins = STILL, STILL.changed(name="Turn")
    one = lesson("Top", stand_ins=stand_ins)
    check_fits(one, robot, [])
    teaching, result, _ = taught(one, robot, Evaluators(Threads(1)))
    mind = teaching.evaluation.mind
    assert {name: list(skill.inputs) for name, skill in mind.skills.items()} == {
        "Top": list(robot.skills["Top"].inputs), "Go": [], "Turn": [],
    }  # fmt: skip
    assert (list(mind.sensors), list(mind.actuators)) == (["S1"], ["X"])
    (learned,) = teaching.learned(result.winner)
    assert learned.changed(genome=None).inputs == robot.skills["Top"].inputs
    assert one.record()["stand_ins"] == ["Go", "Turn"]
    assert "stand_ins" not in lesson("Top").record()


def test_what_was_learned_before_need_not_come_with_the_mind(lesson, robot):
    check_fits(lesson("Top"), robot, ["Go", "Turn"])
    check_fits(lesson("Again", skill="Go", start="known"), robot, ["Go"])
