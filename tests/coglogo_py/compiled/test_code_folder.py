"""The folder of compiled code: used only when it is the user's own, and never believed blindly."""

import os
import stat
import warnings

import numba
import numpy as np
import pytest

from coglogo_py.compiled import code_folder, machine_code
from coglogo_py.compiled.code_folder import CACHE_VARIABLE, CacheWarning, cache_folder, keep, read


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.setenv(CACHE_VARIABLE, str(tmp_path / "cache"))
    code_folder._warn_once.cache_clear()
    return tmp_path / "cache"


def test_what_is_kept_is_read_in_a_folder_of_ones_own(folder):
    keep("key", "name", b"code")
    assert read("key", "name") == b"code"
    assert read("key", "other") is None
    for one in (folder, folder / "key"):
        assert stat.S_IMODE(one.stat().st_mode) == 0o700
    assert stat.S_IMODE((folder / "key" / "name").stat().st_mode) == 0o600
    assert [one.name for one in (folder / "key").iterdir()] == ["name"]


@pytest.mark.parametrize("damaged", [b"", b"short", lambda kept: kept[:-1],
                                     lambda kept: kept + b"x",
                                     lambda kept: bytes([kept[0] ^ 1]) + kept[1:]])  # fmt: skip
def test_what_is_damaged_counts_as_not_there(folder, damaged):
    keep("key", "name", b"code")
    file = folder / "key" / "name"
    file.write_bytes(damaged if isinstance(damaged, bytes) else damaged(file.read_bytes()))
    assert read("key", "name") is None
    keep("key", "name", b"code")
    assert read("key", "name") == b"code"


@pytest.mark.parametrize("place", [".", "key", "key/name"])
def test_what_others_may_write_is_not_read(folder, place):
    keep("key", "name", b"code")
    (folder / place).chmod(0o777)
    assert read("key", "name") is None


@pytest.mark.parametrize("place", [".", "key"])
def test_nothing_is_kept_where_others_may_write(folder, place):
    keep("key", "name", b"code")
    (folder / place).chmod(0o777)
    with pytest.warns(CacheWarning, match="others may write into"):
        keep("key", "other", b"code")
    assert not (folder / "key" / "other").exists()


@pytest.mark.parametrize("place", [".", "key", "key/name"])
def test_what_belongs_to_another_user_is_not_read(folder, place, monkeypatch):
    keep("key", "name", b"code")
    if os.geteuid() == 0:
        os.chown(folder / place, 12345, -1)
    else:
        monkeypatch.setattr(os, "geteuid", lambda: 12345)
    assert read("key", "name") is None


def test_a_linked_folder_within_is_not_followed(folder, tmp_path):
    keep("key", "name", b"code")
    (folder / "key").rename(tmp_path / "elsewhere")
    (folder / "key").symlink_to(tmp_path / "elsewhere")
    assert read("key", "name") is None


def test_without_a_folder_a_warning_says_so_once(tmp_path, monkeypatch):
    (tmp_path / "file").write_text("")
    monkeypatch.setenv(CACHE_VARIABLE, str(tmp_path / "file" / "cache"))
    code_folder._warn_once.cache_clear()
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        keep("key", "name", b"code")
        keep("key", "name", b"code")
    assert len(told) == 1
    assert CACHE_VARIABLE in str(told[0].message)
    assert read("key", "name") is None


def test_a_full_disk_leaves_no_litter(folder, monkeypatch):
    keep("key", "name", b"code")

    def full(*_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "fdopen", full)
    with pytest.warns(CacheWarning, match="No space left"):
        keep("key", "other", b"code")
    assert [one.name for one in (folder / "key").iterdir()] == ["name"]


def test_a_home_written_short_is_the_users(tmp_path, monkeypatch):
    monkeypatch.setenv("HOME", str(tmp_path))
    monkeypatch.setenv(CACHE_VARIABLE, "~/here")
    assert cache_folder() == tmp_path / "here"
    monkeypatch.setattr("os.path.expanduser", lambda path: path)  # as where nobody has a home
    assert cache_folder() is None


def test_a_damaged_function_is_compiled_anew(folder):
    def double(x):
        return 2.0 * x

    assert machine_code.kept("key")(double)(1.5) == 3.0
    (file,) = (folder / "key").iterdir()
    whole, written = file.read_bytes(), file.stat().st_ino

    assert machine_code.kept("key")(double)(1.5) == 3.0
    assert file.stat().st_ino == written  # loaded, and not kept once more

    file.write_bytes(whole[:-100])
    assert machine_code.kept("key")(double)(1.5) == 3.0
    assert file.read_bytes() != whole[:-100]


def test_what_this_process_compiled_shares_nothing_with_what_it_runs(folder):
    inner = numba.njit(lambda x: 2.0 * x)
    outer = machine_code.kept("key")(lambda x: inner(x) + 1.0)
    assert outer(1.5) == 4.0
    (of_inner,), (of_outer,) = inner.overloads.values(), outer.overloads.values()
    assert of_outer.library.codegen is not of_inner.library.codegen
    # Others that are compiled may call it all the same.
    assert numba.njit(lambda x: outer(x) - inner(x))(4.0) == 1.0


def test_compiling_needs_no_folder(tmp_path, monkeypatch):
    (tmp_path / "file").write_text("")
    monkeypatch.setenv(CACHE_VARIABLE, str(tmp_path / "file"))
    code_folder._warn_once.cache_clear()
    with pytest.warns(CacheWarning, match="Not a directory"):
        assert machine_code.kept("key")(lambda x: x + 1)(np.int64(1)) == 2


def test_too_little_memory_is_said_before_compiling(monkeypatch):
    resource = pytest.importorskip("resource")
    monkeypatch.setattr(resource, "getrlimit", lambda _: (400_000 * 1024, 0))
    with pytest.raises(MemoryError, match=r"the limit is 409 MB; raise it with `ulimit -v`"):
        machine_code.check_memory()
