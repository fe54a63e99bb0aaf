"""A sweep as a notebook shows it."""

import base64
import re

import pytest

from socialmind.experiments import Sweep, SweepInterrupted, designs, sweep


def rows_of(shown):
    return dict(re.findall(r"<tr><th>(.*?)</th><td>(.*?)</td></tr>", shown))


def swept(model, out, **options):
    design = designs.grid({"n": [2, 3, 4]})
    return sweep(model, design, 4, range(2), compiled=False, workers=1, out=out, **options)


def test_it_shows_what_it_is_and_what_came_out(gifts, tmp_path):
    folder = swept(gifts, tmp_path / "a & b", measures={"last": "last(tick)"}, every=2)
    shown = Sweep(folder)._repr_html_()
    rows = rows_of(shown)
    assert rows["varies"] == "n" and rows["design"] == "grid, 3 points"
    assert rows["runs"].startswith("6 finished; of 4 ticks") and rows["measures"] == "last"
    assert "a &amp; b" in shown and "status" not in rows
    (picture,) = re.findall(r'base64,([^"]+)', shown)
    assert base64.b64decode(picture).startswith(b"\x89PNG") and len(shown) < 60_000


def test_one_that_was_stopped_shows_how_far_it_came(gifts, tmp_path):
    def stop(done, total):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        swept(gifts, tmp_path / "s", on_progress=stop)
    shown = Sweep(tmp_path / "s")._repr_html_()
    assert rows_of(shown)["status"] == Sweep(tmp_path / "s").manifest.status
    assert rows_of(shown)["runs"].startswith("none yet") and "<img" not in shown


def test_it_draws_nothing_where_nothing_varies(gifts, tmp_path):
    folder = sweep(gifts, None, 2, range(2), compiled=False, workers=1, out=tmp_path / "s")
    shown = Sweep(folder)._repr_html_()
    assert rows_of(shown)["varies"] == "nothing" and "<img" not in shown


def test_what_stopped_it_says_how_to_go_on(tmp_path):
    said = str(SweepInterrupted(tmp_path, 2, 1000, 2))
    assert said == f"stopped after 2 of 1,000 runs; resume_sweep({str(tmp_path)!r}) goes on"
