"""How compiled rules draw the outcomes of interactions, as text."""

from __future__ import annotations

from typing import Any

from socialmind.agents.interaction import SIDES

HEAD = "from socialmind.agents.interaction import weigh as _weigh_outcomes"

_OUTCOME = """BASE_NAME = np.array(BASE)
BEGIN_NAME = np.array(BEGIN, np.int64)
ABILITIES_NAME = np.array(ABILITIES, np.int64)
LINKS_NAME = np.array(LINKS, np.float64)


@_inner
def _outcome_NAME(_model, SIDES, rng):
    values = np.zeros(COUNT)
VALUES
    weights = BASE_NAME.copy()
    _weigh_outcomes(weights, BEGIN_NAME, ABILITIES_NAME, LINKS_NAME, values)
    return _kernel.choose(MAKER, BIAS, weights, _rng_random(rng))"""


def interaction_text(name: str, interaction: Any) -> str:
    """Return the function that draws the outcome of an interaction, called by its name."""
    base, begin, abilities, links = interaction.arrays
    code, bias = interaction.maker
    values = [
        f"    values[{place}] = {side}.{ability}"
        for place, (side, ability) in enumerate(interaction.abilities)
    ]
    fills = {
        "(BASE)": f"({base.tolist()})",
        "(BEGIN,": f"({begin.tolist()},",
        "(ABILITIES,": f"({abilities.tolist()},",
        "(LINKS,": f"({links.tolist()},",
        "COUNT": str(max(len(values), 1)),
        "SIDES": ", ".join(SIDES if interaction.location else SIDES[:2]),
        "\nVALUES": "".join(f"\n{line}" for line in values),
        "MAKER": str(code),
        "BIAS": repr(bias),
    }
    text = _OUTCOME
    for mark, fill in fills.items():
        text = text.replace(mark, fill)
    return text.replace("_NAME", f"_{name}")
