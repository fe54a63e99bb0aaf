"""How compiled rules let one mind take cognitons over from another, as text."""

from __future__ import annotations

from socialmind.compiling.layout import view_function_text

_IMITATE = """@_inner
def _imitate_LEARNER_OTHER(_model, agent, other, mine, theirs):
    model = _asked_OTHER(_model, other)
    learner = _asked_LEARNER(_model, agent)
    return _kernel.imitate(
        _minds_LEARNER(_model), learner, mine, _minds_OTHER(_model), model, theirs
    )"""

_IMITATE_MEMES = """@_inner
def _imitate_memes_LEARNER_OTHER(_model, agent, other):
    memes = _memes_OTHER_LEARNER(_model)
    minds = _minds_LEARNER(_model)
    others = _minds_OTHER(_model)
    model = _asked_OTHER(_model, other)
    learner = _asked_LEARNER(_model, agent)
    count = 0
    for row in range(memes.shape[0]):
        if _kernel.imitate(minds, learner, memes[row, 0], others, model, memes[row, 1]):
            count += 1
    return count"""


def imitation_text(command: str, learner: str, other: str) -> str:
    """Return the function by which minds of one population imitate those of another.

    Args:
        command: "imitate" or "imitate_memes".
        learner: the population of the minds that do.
        other: that of those who are imitated.
    """
    text = _IMITATE
    if command == "imitate_memes":
        view = view_function_text(learner, f"memes_{other}", "int64", 2)
        text = f"{view}\n\n\n{_IMITATE_MEMES}"
    return text.replace("LEARNER", learner).replace("OTHER", other)
