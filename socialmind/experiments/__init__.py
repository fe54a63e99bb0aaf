"""Runs and sweeps as folders that can be stopped, gone on with, made again and read.

- `run`, `resume`: run a model into a folder, go on with one;
- `branch`: go back to a moment of a capsule, change something, and go on;
- `Shock`, `Change`, `Edit`, `Steer`: what is done to a society on its way;
- `replay`: run a capsule again and compare;
- `Run`: read a capsule's tables, parameters and scheme;
- `draw_figures`: draw a run's figures into its folder;
- `score`: measure minds on a plane in many worlds;
- `sweep`, `resume_sweep`: run a model over a design into one folder, go on with it;
- `Sweep`: read a sweep's tables; `remake_run`: make one of its runs again as a capsule;
- `sensitivity_of`: what the outputs of a sweep depend on;
- `fit`, `resume_fit`: fit a model to data, with recovery; `Fit`: read what came of it.
"""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from socialmind.experiments.calibration.fit import fit as fit
    from socialmind.experiments.calibration.fit import resume_fit as resume_fit
    from socialmind.experiments.calibration.leading import FitInterrupted as FitInterrupted
    from socialmind.experiments.calibration.result import Fit as Fit
    from socialmind.experiments.scoring import Score as Score
    from socialmind.experiments.scoring import score as score
    from socialmind.experiments.sensitivity.indices import Sensitivity as Sensitivity
    from socialmind.experiments.sensitivity.indices import sensitivity_of as sensitivity_of
    from socialmind.experiments.sweeps.leading import SweepInterrupted as SweepInterrupted
    from socialmind.experiments.sweeps.remaking import remake_run as remake_run
    from socialmind.experiments.sweeps.result import Sweep as Sweep
    from socialmind.experiments.sweeps.sweep import resume_sweep as resume_sweep
    from socialmind.experiments.sweeps.sweep import sweep as sweep
    from socialmind.interventions.change import Change as Change
    from socialmind.interventions.edit import Edit as Edit
    from socialmind.interventions.shock import Shock as Shock
    from socialmind.interventions.steer import Steer as Steer
    from socialmind.runs.branching.branch import branch as branch
    from socialmind.runs.execution import Interrupted as Interrupted
    from socialmind.runs.execution import resume as resume
    from socialmind.runs.execution import run as run
    from socialmind.runs.figures import draw_figures as draw_figures
    from socialmind.runs.result import Run as Run
    from socialmind.runs.verification import Replay as Replay
    from socialmind.runs.verification import replay as replay
else:
    from coglogo_py.on_demand import on_demand

    __getattr__, __dir__, __all__ = on_demand(
        __name__,
        {
            "socialmind.experiments.calibration.fit": "fit resume_fit",
            "socialmind.experiments.calibration.leading": "FitInterrupted",
            "socialmind.experiments.calibration.result": "Fit",
            "socialmind.experiments.scoring": "Score score",
            "socialmind.experiments.sensitivity.indices": "Sensitivity sensitivity_of",
            "socialmind.experiments.sweeps.remaking": "remake_run",
            "socialmind.experiments.sweeps.result": "Sweep",
            "socialmind.experiments.sweeps.leading": "SweepInterrupted",
            "socialmind.experiments.sweeps.sweep": "resume_sweep sweep",
            "socialmind.interventions.change": "Change",
            "socialmind.interventions.edit": "Edit",
            "socialmind.interventions.shock": "Shock",
            "socialmind.interventions.steer": "Steer",
            "socialmind.runs.branching.branch": "branch",
            "socialmind.runs.execution": "Interrupted resume run",
            "socialmind.runs.figures": "draw_figures",
            "socialmind.runs.result": "Run",
            "socialmind.runs.verification": "Replay replay",
        },
    )
