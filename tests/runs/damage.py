"""Damaging a folder in every way that hands and disks do, one at a time."""

import hashlib
import json
import shutil

VALUES = (
    None,
    -1,
    0,
    3,
    2.5,
    10**30,
    1e400,
    True,
    "",
    "x",
    "../x",
    "/etc/passwd",
    [],
    [1],
    {},
    {"a": 1},
)


def files_of(folder):
    """The files of a folder but its lock, by path."""
    return sorted(path for path in folder.rglob("*") if path.is_file() and path.name != ".lock")


def digest(folder):
    """What a folder holds but its lock and figures: links as links."""
    found = {}
    for path in sorted(folder.rglob("*")):
        name = path.relative_to(folder).as_posix()
        if name == ".lock" or name.startswith("figures"):
            continue
        if path.is_symlink():
            found[name] = str(path.readlink())
        elif path.is_dir():
            found[name] = "a folder"
        else:
            found[name] = hashlib.sha256(path.read_bytes()).hexdigest()
    return found


def fields_of(value, place=()):
    """Every field of a JSON value, as the path to it."""
    if isinstance(value, dict):
        for name, one in value.items():
            yield (*place, name)
            yield from fields_of(one, (*place, name))
    elif isinstance(value, list):
        for number, one in enumerate(value[:1]):
            yield (*place, number)
            yield from fields_of(one, (*place, number))


def harm_file(path, how, rng, elsewhere):
    """Do something to a file."""
    content = bytearray(path.read_bytes())
    if how == "delete":
        path.unlink()
    elif how == "empty":
        path.write_bytes(b"")
    elif how == "truncate":
        path.write_bytes(content[: rng.randrange(len(content))] if content else b"")
    elif how == "flip":
        for _ in range(rng.choice([1, 1, 3])):
            place = rng.randrange(len(content))
            content[place] ^= 1 << rng.randrange(8)
        path.write_bytes(content)
    elif how == "append":
        path.write_bytes(content + b"more")
    elif how == "folder":
        path.unlink()
        path.mkdir()
    elif how == "link":
        target = elsewhere / path.name
        shutil.move(path, target)
        path.symlink_to(target)
    elif how == "dangling":
        path.unlink()
        path.symlink_to(elsewhere / "nothing")
    elif how == "loop":
        path.unlink()
        path.symlink_to(path.name)


HARMS = ("delete", "empty", "truncate", "flip", "append", "folder", "link", "dangling", "loop")


def harm_record(path, place, value):
    """Give a field of a JSON file another value; remove it for `harm_record`'s own default."""
    content = json.loads(path.read_text())
    inner = content
    for name in place[:-1]:
        inner = inner[name]
    if value is harm_record:
        del inner[place[-1]]
    else:
        inner[place[-1]] = value
    path.write_text(json.dumps(content))
