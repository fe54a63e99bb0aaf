"""Which commit of its repository the program is."""

import subprocess

from socialmind.sources.commit import own_commit


def git(folder, *words):
    who = ("-c", "user.name=a", "-c", "user.email=a@b")
    done = subprocess.run(
        ["git", "-C", str(folder), *who, *words], check=True, capture_output=True, text=True
    )
    return done.stdout.strip()


def test_a_clone_has_one_until_the_program_is_edited(tmp_path):
    (tmp_path / "socialmind").mkdir()
    (tmp_path / "socialmind" / "model.py").write_text("a = 1")
    (tmp_path / "coglogo_py").mkdir()
    (tmp_path / "coglogo_py" / "mind.py").write_text("a = 1")
    assert own_commit(tmp_path) == ""  # installed, not cloned
    git(tmp_path, "init", "--quiet")
    assert own_commit(tmp_path) == ""  # nothing is in it yet
    git(tmp_path, "add", ".")
    git(tmp_path, "commit", "--quiet", "--message", "Begin")
    commit = own_commit(tmp_path)
    assert len(commit) == 10
    assert git(tmp_path, "rev-parse", "HEAD").startswith(commit)
    (tmp_path / "notes.md").write_text("of no program")
    assert own_commit(tmp_path) == commit
    (tmp_path / "socialmind" / "model.py").write_text("a = 2")
    assert own_commit(tmp_path) == ""
