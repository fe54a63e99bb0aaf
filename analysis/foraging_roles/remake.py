"""Make the mind of `foraging_roles` anew, when the Collect that it is built on has changed.

python -m analysis.foraging_roles.remake                    # with the ForageRole that it has
python -m analysis.foraging_roles.remake trainings/foraging_roles-001/mind-attempt-1

The economy in which ForageRole is learned has no bodies, so it need not be learned anew.
"""

from __future__ import annotations

import shutil
import sys
from pathlib import Path

from socialmind.mind import MindDescription

from .trainings import LESSONS, MODEL


def remade(learned: MindDescription) -> MindDescription:
    """Return the mind of the lessons with the ForageRole of another.

    Args:
        learned: the other.
    """
    begun: MindDescription = LESSONS.curriculum.mind
    role = begun.skill(LESSONS.ROLE).changed(genome=learned.skill(LESSONS.ROLE).genome)
    return begun.with_modules(skills=[role])


def main(source: Path = MODEL / "mind") -> None:
    """Write the mind into the model's folder, in place of the one that is there."""
    mind = remade(MindDescription.load(source))
    shutil.rmtree(MODEL / "mind")
    mind.save(MODEL / "mind")


if __name__ == "__main__":
    main(*map(Path, sys.argv[1:]))
