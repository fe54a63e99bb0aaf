"""What kept trainings took, in words."""

from socialmind.experiments.trainings.budgets import budget_of
from socialmind.learning import Training


def test_attempts_lessons_and_ticks_are_told(tmp_path, tiny_plans):
    folder = tmp_path / "tiny"
    tiny_plans.PLAN.train(folder, workers=1)
    each = Training(folder).lessons.groupby("attempt")["ticks"].sum()
    told = budget_of(folder)
    assert told.startswith(f"{len(each)} attempts, 2 lessons, {each.median() / 1e6:,.0f} million")
    assert ("on the median" in told) == (each.nunique() > 1)
