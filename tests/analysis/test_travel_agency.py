"""The study of brokers: what a market comes to, and the table and the figure made of it."""

from pathlib import Path

import pandas as pd

from socialmind.sources.loading import load_file

STUDY = load_file(Path(__file__).parents[2] / "analysis" / "travel_agency" / "study.py")


def test_one_broker_is_the_same_with_groups_in_common_and_of_its_own():
    rows = [STUDY.outcome(1, apart, seed=2, ticks=400) for apart in (False, True)]
    for name in STUDY.MEASURES:
        assert rows[0][name] == rows[1][name]
    assert 0 < rows[0]["served"] < 1


def test_table_and_figure_have_every_number_of_brokers():
    row = dict.fromkeys(STUDY.MEASURES, 2.0)
    results = pd.DataFrame(
        [
            {"brokers": brokers, "apart": apart, "seed": seed, **row}
            for brokers in STUDY.BROKERS
            for apart in (False, True)
            for seed in (0, 1)
        ]
    )
    lines = STUDY.table(results).splitlines()[2:]
    assert len(lines) == 2 * len(STUDY.BROKERS)
    assert lines[0].startswith("| in common | 1 | 2.00 (2.00 – 2.00) | 2 (2 – 2) |")
    for axes in STUDY.draw(results).axes:
        assert list(axes.lines[0].get_xdata()) == list(STUDY.BROKERS)
