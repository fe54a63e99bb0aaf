"""Compiled code is of today's files: those that it is made from, and those that these import."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import coglogo_py

DRAW = """
import numpy as np
from coglogo_py import kernel
from coglogo_py.compiled.machine_code import kept

@kept(kernel._KEY)
def draw(seed):
    return kernel.uniforms(0, 0, 0, 0, seed, 0)[0]

print(kernel._KEY, draw(1))
"""


def test_an_edited_helper_of_the_kernel_is_compiled_anew(tmp_path):
    package = tmp_path / "coglogo_py"
    shutil.copytree(Path(coglogo_py.__file__).parent, package)
    script = tmp_path / "draw.py"
    script.write_text(DRAW)
    environment = {
        **os.environ,
        "PYTHONPATH": os.pathsep.join([str(tmp_path), *sys.path]),
        "SOCIALMIND_CACHE_DIR": str(tmp_path / "cache"),
    }

    def drawn():
        done = subprocess.run(
            [sys.executable, str(script)], env=environment, capture_output=True, text=True
        )
        assert done.returncode == 0, done.stderr
        return done.stdout.split()

    def edit(name, before, after):
        text = (package / name).read_text("utf-8")
        assert before in text
        (package / name).write_text(text.replace(before, after))

    key, value = drawn()
    edit("lint.py", '"""The linter', '"""A linter')
    assert drawn() == [key, value]  # nothing that it stands on
    edit("streams.py", "/ 9007199254740992.0\n    second", "/ 18014398509481984.0\n    second")
    again, half = drawn()
    assert again != key
    assert float(half) == float(value) / 2
    edit("compiled/borrow.py", '"""Arrays', '"""The arrays')
    assert drawn()[0] not in (key, again)
