"""Learning: how the genomes of a mind's skills come about.

- `Lesson`, `Curriculum`, `Cycle`: what is learned, in which order;
- `learn`, `resume`: teach a mind, into a folder that can be gone on with;
- `pause`: ask a training to stop for now, wherever it goes on;
- `Training`: read such a folder.
"""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from socialmind.learning.lessons.curriculum import Curriculum as Curriculum
    from socialmind.learning.lessons.curriculum import Cycle as Cycle
    from socialmind.learning.lessons.lesson import Lesson as Lesson
    from socialmind.learning.training.execution import TrainingInterrupted as TrainingInterrupted
    from socialmind.learning.training.execution import learn as learn
    from socialmind.learning.training.execution import resume as resume
    from socialmind.learning.training.pausing import pause as pause
    from socialmind.learning.training.result import Training as Training
else:
    from coglogo_py.on_demand import on_demand

    __getattr__, __dir__, __all__ = on_demand(
        __name__,
        {
            "socialmind.learning.lessons.curriculum": "Curriculum Cycle",
            "socialmind.learning.lessons.lesson": "Lesson",
            "socialmind.learning.training.execution": "TrainingInterrupted learn resume",
            "socialmind.learning.training.pausing": "pause",
            "socialmind.learning.training.result": "Training",
        },
    )
