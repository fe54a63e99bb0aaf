"""Faults in files: what a bad disk, an editor or an enemy makes of sound ones."""

import os
from datetime import UTC, datetime

SEED = int(os.environ.get("SOCIALMIND_FUZZ_SEED", datetime.now(UTC).strftime("%Y%m%d")))
"""Of all that is drawn; it changes from day to day."""


def mutated(content, chance, hostile):
    """A content with one to four faults: bytes, lines, their order, numbers, marks or texts.

    Args:
        content: bytes.
        chance: a `random.Random`.
        hostile: texts that a format may trip over.
    """
    for _ in range(chance.randint(1, 4)):
        place = chance.randrange(len(content) + 1)
        lines = content.splitlines(keepends=True) or [b""]
        line = chance.randrange(len(lines))
        match chance.randrange(7):
            case 0:
                content = content[:place] + bytes([chance.randrange(256)]) + content[place + 1 :]
            case 1:
                content = b"".join(lines[:line] + lines[line + 1 :])
            case 2:
                content = b"".join(lines[: line + 1] * chance.randint(1, 3) + lines[line:])
            case 3:
                content = content[:place]
            case 4:
                content = content[:place] + chance.choice(hostile) + content[place:]
            case 5:
                chance.shuffle(lines)
                content = b"".join(lines)
            case _:
                old = bytes([chance.choice(b"0123456789,:()")])
                content = content.replace(old, chance.choice(hostile), chance.randint(1, 3))
    return content
