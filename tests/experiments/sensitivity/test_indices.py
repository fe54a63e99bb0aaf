"""Indices of real sweeps agree with theory; what a design cannot tell is refused or said."""

import math
import random
import sys

import numpy as np
import pandas as pd
import pytest
from SALib.analyze import morris as salib_morris

from socialmind.errors import SocialmindError
from socialmind.experiments import Sweep, designs, resume_sweep, sensitivity_of
from socialmind.experiments.sweeps import leading
from socialmind.experiments.sweeps.tables import window

RANGES = dict.fromkeys("abc", (-math.pi, math.pi))

PI = math.pi
V13 = 8 * 0.01 * PI**8 / 225
VARIANCE = 49 / 8 + 0.1 * PI**4 / 5 + 0.01 * PI**8 / 18 + 0.5
FIRST = {"a": 0.5 * (1 + 0.1 * PI**4 / 5) ** 2 / VARIANCE, "b": 49 / 8 / VARIANCE, "c": 0.0}
TOTAL = {"a": FIRST["a"] + V13 / VARIANCE, "b": FIRST["b"], "c": V13 / VARIANCE}
"""Of the Ishigami function (Ishigami and Homma, 1990), with 7 and 0.1."""
OF_LINE = 13 * PI**2 / 3
"""The variance of 3 a + 2 b."""


def row(found, output, index, parameter="", other=""):
    rows = found.of(output, index)
    (one,) = rows[(rows["parameter"] == parameter) & (rows["other"] == other)].itertuples()
    return one


def holds(one, theory, widest=0.5):
    return one.low <= theory <= one.high and one.high - one.low < widest


def test_sobol_indices_of_saltelli_s_design_agree_with_theory(sobol_sweep):
    found = sensitivity_of(sobol_sweep, ["ishigami", "linear"])
    assert (found.method, found.design, found.parameters) == ("sobol", "saltelli", ("a", "b", "c"))
    for name in RANGES:
        assert holds(row(found, "ishigami", "first", name), FIRST[name])
        assert holds(row(found, "ishigami", "total", name), TOTAL[name])
        line = {"a": 9 / 13, "b": 4 / 13, "c": 0.0}[name]
        assert holds(row(found, "linear", "first", name), line)
        assert holds(row(found, "linear", "total", name), line)
    for pair, theory in {("a", "b"): 0.0, ("a", "c"): V13 / VARIANCE, ("b", "c"): 0.0}.items():
        assert holds(row(found, "ishigami", "second", *pair), theory, 0.8)
    assert row(found, "ishigami", "second", "a", "c").low > 0
    assert found.ordered("linear") == ["a", "b", "c"]
    assert any("one run each" in note for note in found.notes)


def test_luck_has_a_share_of_its_own_and_lifts_total_indices(swept):
    folder = swept(designs.saltelli(RANGES, 128), seeds=range(4), fixed={"luck": 6.0})
    found = sensitivity_of(folder, ["linear"])
    (luck,) = found.luck.itertuples()
    assert luck.variance_of_luck_low < 36 < luck.variance_of_luck_high
    assert luck.luck_of_a_run_low < 36 / (36 + OF_LINE) < luck.luck_of_a_run_high
    assert luck.luck_of_means == pytest.approx(9 / (9 + OF_LINE), rel=0.1)
    assert luck.floor == luck.luck_of_means
    nothing = row(found, "linear", "total", "c")
    assert nothing.low < luck.floor < nothing.high
    assert holds(row(found, "linear", "first", "a"), 9 * PI**2 / 3 / (OF_LINE + 9))
    assert not any("one run each" in note for note in found.notes)


def test_common_seeds_move_all_points_alike(swept):
    options = {"seeds": range(4), "fixed": {"luck": 6.0}}
    found = sensitivity_of(swept(designs.saltelli(RANGES, 16), common=True, **options), ["linear"])
    (luck,) = found.luck.itertuples()
    assert luck.luck_of_a_run > 0.1  # four draws of a normal number
    assert luck.luck_of_means == pytest.approx(0.0, abs=1e-12)
    assert row(found, "linear", "total", "c").value == pytest.approx(0.0, abs=1e-12)
    assert any("share their seeds" in note for note in found.notes)


def test_fast_agrees_with_theory(swept):
    found = sensitivity_of(swept(designs.fast(RANGES, 257)), ["ishigami", "linear"])
    assert found.method == "fast"
    for name in RANGES:
        for index, theory in (("first", FIRST), ("total", TOTAL)):
            one = row(found, "ishigami", index, name)
            assert abs(one.value - theory[name]) < 0.06  # with four harmonics, whatever the points
            assert one.low <= one.value <= one.high
        line = {"a": 9 / 13, "b": 4 / 13, "c": 0.0}[name]
        assert row(found, "linear", "first", name).value == pytest.approx(line, abs=0.03)
    assert found.of("linear", "second").empty


def test_morris_effects_are_over_the_range_in_the_output_s_unit(swept):
    design = designs.morris(RANGES | {"n": (1, 3)}, 30, whole=["n"])
    found = sensitivity_of(swept(design), ["linear", "whole", "ishigami"])
    for name, slope in {"a": 3.0, "b": 2.0, "c": 0.0, "n": 0.0}.items():
        for index in ("mu", "mu_star"):
            assert row(found, "linear", index, name).value == pytest.approx(slope * 2 * PI)
        assert row(found, "linear", "sigma", name).value == pytest.approx(0.0, abs=1e-9)
    # Steps of n are of one or of two, which SALib takes for two thirds of the range each.
    assert row(found, "whole", "mu", "n").value == pytest.approx(20.0)
    assert row(found, "whole", "sigma", "n").value == pytest.approx(0.0, abs=1e-9)
    folded = row(found, "ishigami", "mu", "b"), row(found, "ishigami", "mu_star", "b")
    assert folded[0].low < 0 < folded[0].high and folded[1].low > 5
    assert found.ordered("linear")[:2] == ["a", "b"]


def test_morris_indices_are_salib_s_where_steps_are_equal(swept):
    folder = swept(designs.morris(RANGES, 12))
    found = sensitivity_of(folder, ["ishigami"])
    sweep = Sweep(folder)
    problem = {"num_vars": 3, "names": list("abc"), "bounds": list(RANGES.values())}
    points, values = sweep.design[list("abc")], sweep.runs["ishigami"]
    theirs = salib_morris.analyze(problem, points.to_numpy(), values.to_numpy(), seed=1)
    for index in ("mu", "mu_star", "sigma"):
        ours = found.of("ishigami", index)["value"].to_numpy()
        assert ours == pytest.approx(np.asarray(theirs[index], float))


def test_the_floor_of_morris_is_what_nothing_has_by_luck(swept):
    folder = swept(designs.morris(RANGES, 60), seeds=range(3), fixed={"luck": 3.0})
    found = sensitivity_of(folder, ["linear"])
    nothing = row(found, "linear", "mu_star", "c")
    (luck,) = found.luck.itertuples()
    assert luck.floor == pytest.approx(math.sqrt(4 * 3 / PI) * 1.5, rel=0.2)
    assert nothing.low < luck.floor < nothing.high


def test_regression_of_a_hypercube_agrees_with_theory(swept):
    design = designs.lhs(RANGES, 200, seed=3)
    folder = swept(design, seeds=range(3), fixed={"luck": 2.0})
    found = sensitivity_of(folder, ["linear", "square"])
    assert found.method == "regression"
    (luck, _) = found.luck.itertuples()
    assert luck.variance_of_luck_low < 4 < luck.variance_of_luck_high
    held = OF_LINE / (OF_LINE + 4 / 3)
    assert holds(row(found, "linear", "r_squared"), held)
    for name, slope in {"a": 3.0, "b": 2.0, "c": 0.0}.items():
        theory = slope * PI / math.sqrt(3) / math.sqrt(OF_LINE + 4 / 3)
        assert holds(row(found, "linear", "src", name), theory, 0.2)
    assert row(found, "linear", "partial_rank_correlation", "a").low > 0.9
    # A parabola is neither a line nor monotone, and R² says so.
    assert row(found, "square", "r_squared").high < 0.1
    assert abs(row(found, "square", "partial_rank_correlation", "a").value) < 0.2


def test_the_sequence_called_sobol_is_not_taken_for_the_indices(swept):
    found = sensitivity_of(swept(designs.sobol(RANGES, 16)), ["linear"])
    assert found.method == "regression"
    assert any("Sobol indices need saltelli" in note for note in found.notes)


def test_replicates_that_were_added_where_it_was_wanted_are_averaged(swept):
    options = {"seeds": range(5), "until": "1.5:linear", "at_most": 20, "fixed": {"luck": 2.0}}
    found = sensitivity_of(swept(designs.morris(RANGES, 4), **options), ["linear"])
    (luck,) = found.luck.itertuples()
    assert 16 * 5 < luck.runs < 16 * 20
    assert not any("fewer runs" in note for note in found.notes)


def test_a_perfect_line_is_told_without_luck(swept):
    found = sensitivity_of(swept(designs.lhs({"a": (0.0, 1.0), "b": (0.0, 1.0)}, 30)), ["linear"])
    assert row(found, "linear", "r_squared").value == 1.0
    alone = sensitivity_of(swept(designs.grid({"a": [0.0, 1.0, 2.0, 3.0]})), ["linear"])
    assert row(alone, "linear", "src", "a").value == pytest.approx(1.0)
    assert row(alone, "linear", "partial_rank_correlation", "a").value == pytest.approx(1.0)


def test_one_parameter_has_all_and_no_pair(swept):
    found = sensitivity_of(swept(designs.saltelli({"a": (-1.0, 1.0)}, 64)), ["linear"])
    one = row(found, "linear", "first", "a")
    assert one.low < 1 < one.high and found.of("linear", "second").empty


def test_names_have_a_correlation_ratio_and_leave_the_line_alone(swept):
    grid = designs.grid({"word": ["low", "high"], "a": np.linspace(-2, 2, 12).tolist()})
    found = sensitivity_of(swept(grid), ["linear"])
    assert found.of("linear", "src")["parameter"].tolist() == ["a"]
    lies_between = 6.25 / (6.25 + 9 * np.linspace(-2, 2, 12).var())
    assert row(found, "linear", "correlation_ratio", "word").value == pytest.approx(lies_between)
    assert row(found, "linear", "r_squared").value == pytest.approx(1.0)
    assert any("names have no order" in note for note in found.notes)


def test_columns_that_say_the_same_or_nothing_are_left_out(swept):
    a = np.linspace(-1, 1, 20)
    table = pd.DataFrame({"a": a, "b": 2 * a, "c": 0.5, "luck": np.r_[a[10:], a[:10]] + 1})
    found = sensitivity_of(swept(table), ["linear"])
    assert found.of("linear", "src")["parameter"].tolist() == ["a", "luck"]
    said = " ".join(found.notes)
    assert "b follows from a" in said and "c is 0.5 at all points" in said
    assert "a and luck go together" in said


def test_outputs_by_default_are_measures_else_the_ends_of_series(swept, sobol_sweep):
    measured = swept(designs.lhs(RANGES, 20), measures={"twice": "2 * last(linear)"})
    assert sensitivity_of(measured).outputs == ("twice",)
    assert sensitivity_of(measured, ["twice", "square"]).outputs == ("twice", "square")
    found = sensitivity_of(sobol_sweep)
    assert found.outputs == ("ishigami", "linear", "whole", "square")
    said = " ".join(found.notes)
    assert "nothing is 4 at all points" in said and "no value of hole" in said


def test_what_cannot_be_told_is_refused(sobol_sweep, swept):
    for of, words in {
        "nothing": "nothing is 4 at all points: it depends on nothing that varies",
        "hole": "saltelli needs a value at every point, and .* --regression",
        "linaer": "no output 'linaer' that is a number; did you mean 'linear'",
        "a": "a is what varies, no output",
    }.items():
        with pytest.raises(SocialmindError, match=words):
            sensitivity_of(sobol_sweep, [of])
    with pytest.raises(SocialmindError, match="level: found 95; expected a number between 0 and 1"):
        sensitivity_of(sobol_sweep, level=95)
    with pytest.raises(SocialmindError, match="nothing varies in this sweep"):
        sensitivity_of(swept(None))
    with pytest.raises(SocialmindError, match="3 points with a value of linear for a line through"):
        sensitivity_of(swept(designs.lhs(RANGES, 3)), ["linear"])
    with pytest.raises(
        SocialmindError, match=r"trajectories of the design: found 1; expected 4 or more"
    ):
        sensitivity_of(swept(designs.morris(RANGES, 1)), ["linear"])
    with pytest.raises(
        SocialmindError, match=r"blocks of the design: found 4; expected 8 .* saltelli:32"
    ):
        sensitivity_of(swept(designs.saltelli(RANGES, 4)), ["linear"])


def test_regression_goes_on_without_what_is_missing(sobol_sweep):
    found = sensitivity_of(sobol_sweep, ["hole"], regress=True)
    assert found.method == "regression"
    assert found.luck["points"].item() < 1024
    assert any(
        "of 1,024 points have no value of hole" in note and "left out" in note
        for note in found.notes
    )


def test_failed_runs_are_counted_and_the_way_on_is_said(swept):
    def odd(model):
        return 1 / 0 if model.a > 2 else model.a

    folder = swept(designs.morris(RANGES, 8), measures={"odd": odd})
    failed = int((Sweep(folder).runs["status"] == "failed").sum())
    words = f"did not finish: {failed} failed; go on with `socialmind sweep --resume .* --retry`"
    with pytest.raises(SocialmindError, match=words):
        sensitivity_of(folder)


def test_failed_replicates_are_said(swept):
    def odd(model):
        return 1 / 0 if model.drawn > 1 else model.a

    found = sensitivity_of(swept(designs.morris(RANGES, 8), seeds=range(9), measures={"odd": odd}))
    assert any("points have fewer runs than others" in note for note in found.notes)
    assert row(found, "odd", "mu", "a").value == pytest.approx(2 * PI)


class Enough(Exception):
    pass


def test_a_stopped_sweep_is_refused_until_it_is_gone_on_with(swept, monkeypatch, tmp_path):
    monkeypatch.setattr(leading, "JOB_SECONDS", 0.0)
    monkeypatch.setattr(window, "WINDOW_SECONDS", (0.0, 0.0))

    def tell(done, _):
        if done >= 20:
            raise Enough

    whole = sensitivity_of(swept(designs.morris(RANGES, 8)), ["linear"])
    with pytest.raises(Enough):
        swept(designs.morris(RANGES, 8), on_progress=tell, out=tmp_path / "s")
    with pytest.raises(SocialmindError, match=r"not run yet; go on with"):
        sensitivity_of(tmp_path / "s", ["linear"])
    part = sensitivity_of(tmp_path / "s", ["linear"], regress=True)
    assert part.luck["points"].item() < 32
    resume_sweep(tmp_path / "s", workers=1)
    again = sensitivity_of(tmp_path / "s", ["linear"])
    pd.testing.assert_frame_equal(again.table, whole.table)


@pytest.mark.parametrize("name", ["saltelli", "morris", "fast"])
def test_points_that_were_moved_are_not_the_design(swept, name):
    size = {"saltelli": 4, "morris": 4, "fast": 65}[name]
    design = designs.SAMPLERS[name].make(RANGES, size)
    moved = design.sample(frac=1.0, random_state=1).reset_index(drop=True)
    further = design.assign(luck=1.0)
    for one in (moved, further, design.iloc[:-1]):
        assert one.attrs["design"]["name"] == name  # which pandas keeps
        folder = swept(one)
        with pytest.raises(SocialmindError, match=f"points are not those that {name} makes"):
            sensitivity_of(folder, ["linear"])
        assert sensitivity_of(folder, ["linear"], regress=True).method == "regression"


def test_a_design_that_was_stored_as_csv_is_a_table(swept, tmp_path):
    designs.saltelli(RANGES, 16).to_csv(tmp_path / "design.csv", index=False)
    found = sensitivity_of(swept(tmp_path / "design.csv"), ["linear"])
    assert (found.method, found.design, found.ranges) == ("regression", "table", {})


def test_it_hangs_on_seed_and_runs_alone(swept, tmp_path):
    folder = swept(designs.saltelli(RANGES, 16))
    np.random.seed(5)  # noqa: NPY002
    random.seed(5)
    before = np.random.get_state()[1].tolist(), random.getstate()  # noqa: NPY002
    first = sensitivity_of(folder, ["linear", "ishigami"])
    rows = Sweep(folder).runs
    rows.sample(frac=1.0, random_state=1).to_parquet(folder / "runs.parquet", index=False)
    points = Sweep(folder).design
    points.sample(frac=1.0, random_state=2).to_parquet(folder / "design.parquet", index=False)
    again = sensitivity_of(folder, ["ishigami", "linear"])
    for output in ("linear", "ishigami"):
        for index in ("first", "total", "second"):
            pd.testing.assert_frame_equal(again.of(output, index), first.of(output, index))
    assert (np.random.get_state()[1].tolist(), random.getstate()) == before  # noqa: NPY002
    other = sensitivity_of(folder, ["linear"], seed=1).of("linear", "total")
    assert other["value"].equals(first.of("linear", "total")["value"])
    assert not other["low"].equals(first.of("linear", "total")["low"])
    narrow = sensitivity_of(folder, ["linear"], level=0.5).of("linear", "total")
    wide = first.of("linear", "total")
    assert ((narrow["high"] - narrow["low"]) < (wide["high"] - wide["low"]))[:2].all()
    fast = swept(designs.fast(RANGES, 65))
    zero, again = (sensitivity_of(fast, ["linear"]).table for _ in range(2))
    pd.testing.assert_frame_equal(zero, again)
    assert (np.random.get_state()[1].tolist(), random.getstate()) == before  # noqa: NPY002


def test_the_unit_of_an_output_changes_no_share(swept):
    tiny = {"tiny": "1e-20 * last(ishigami)", "far": "1e6 + last(ishigami)"}
    for design in (designs.saltelli(RANGES, 32), designs.fast(RANGES, 65)):
        found = sensitivity_of(swept(design, measures=tiny), ["ishigami", "tiny", "far"])
        for output in tiny:
            ours = found.of(output, "total")["value"].to_numpy()
            assert ours == pytest.approx(found.of("ishigami", "total")["value"].to_numpy())


def test_no_warning_reaches_the_user(swept, recwarn):
    for design in (designs.saltelli(RANGES, 8), designs.fast(RANGES, 65), designs.lhs(RANGES, 8)):
        found = sensitivity_of(swept(design), ["linear"])
        assert np.isfinite(found.table["value"]).any()
    assert [str(one.message) for one in recwarn] == []
    assert any("intervals are rough" in note for note in found.notes)


@pytest.mark.parametrize("made", [{}, {"ranges": 3}, {"ranges": {"a": [1, 0], "b": [0, 1]}}])
@pytest.mark.parametrize("name", ["saltelli", "morris", "fast"])
def test_a_table_that_only_says_it_is_a_design_is_not_believed(swept, name, made):
    table = designs.lhs({"a": (0.0, 1.0), "b": (0.0, 1.0)}, 12)
    words = table.assign(word="high")
    for one, said in ((table, made), (words, {"ranges": {key: [0, 1] for key in words}})):
        one.attrs["design"] = {"name": name, **said}
        with pytest.raises(SocialmindError, match=f"manifest says {name}, but its points are not"):
            sensitivity_of(swept(one), ["linear"])


def test_a_missing_library_is_said(sobol_sweep, monkeypatch):
    monkeypatch.setitem(sys.modules, "SALib.analyze.sobol", None)
    with pytest.raises(SocialmindError, match=r"needs SALib: pip install 'socialmind\[sensitiv"):
        sensitivity_of(sobol_sweep, ["linear"])
