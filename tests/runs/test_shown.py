"""A run as a notebook shows it."""

import base64
import re

import pytest

from socialmind.experiments import Run, run


def test_a_run_shows_what_it_is_and_where(drifters, tmp_path):
    folder = run(drifters, 30, 3, {"n": 4}, out=tmp_path / "a & b")
    shown = Run(folder)._repr_html_()
    for text in ("<th>model</th><td>Drifters</td>", "30 of 30, finished", "n 4", "a &amp; b"):
        assert text in shown
    (picture,) = re.findall(r"base64,([^\"]+)", shown)
    assert base64.b64decode(picture).startswith(b"\x89PNG")


def test_a_run_that_failed_says_why(drifters, tmp_path):
    with pytest.raises(Exception, match="division by zero"):
        run(drifters, 30, 3, {"fail_at": 7}, out=tmp_path / "run")
    shown = Run(tmp_path / "run")._repr_html_()
    assert "failed" in shown and "ZeroDivisionError" in shown and "<img" not in shown
