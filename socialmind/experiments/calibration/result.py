"""Reading a fit's folder."""

from __future__ import annotations

import json
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

from socialmind.errors import SocialmindError
from socialmind.experiments.calibration.capsule import TARGET, FitCapsule, FitManifest
from socialmind.experiments.calibration.reporting import identifying
from socialmind.experiments.calibration.reporting.tables import (
    BEST_RUNS,
    PROFILES,
    RECOVERY,
    TRIALS,
)
from socialmind.experiments.calibration.target import Target
from socialmind.runs.folders import FINISHED

if TYPE_CHECKING:
    import pandas as pd

BEST = "best.json"


class Fit:
    """A fit as its folder tells it; every table is read when first asked for.

    >>> from socialmind.experiments import Fit                               # doctest: +SKIP
    >>> found = Fit("fits/farmer_artisan-001")                               # doctest: +SKIP
    >>> found.parameters[["parameter", "found", "low", "high", "verdict"]]   # doctest: +SKIP

    Args:
        folder: the fit's.

    Raises:
        SocialmindError: the folder is no fit's, or the fit has not come to its end.
    """

    def __init__(self, folder: str | Path) -> None:
        self._capsule = FitCapsule(folder)
        if self.manifest.status != FINISHED:
            raise SocialmindError(
                f"{self.folder}: this fit has not come to its end ({self.manifest.status}); "
                f"go on with it: socialmind fit --resume {folder}"
            )

    @property
    def folder(self) -> Path:
        """The fit's folder."""
        return self._capsule.folder

    @property
    def manifest(self) -> FitManifest:
        """What the fit is: model, target, method, what varies, versions, status."""
        return self._capsule.manifest

    @cached_property
    def target(self) -> Target:
        """The data."""
        return Target.of_csv((self.folder / TARGET).read_bytes(), self.manifest.target["file"])

    @cached_property
    def best(self) -> dict[str, Any]:
        """The content of `best.json`: the values found, distances, intervals, how to run it."""
        content: dict[str, Any] = json.loads((self.folder / BEST).read_text("utf-8"))
        return content

    @property
    def values(self) -> dict[str, float]:
        """The values found, by name."""
        return dict(self.best["values"])

    @cached_property
    def trials(self) -> pd.DataFrame:
        """One row a trial of the fit and of its recoveries; `search` is 0 for the fit's."""
        return self._table(TRIALS)

    @cached_property
    def recovery(self) -> pd.DataFrame:
        """One row for each recovery and parameter: true and found, interval, whether it covers."""
        return self._table(RECOVERY)

    @cached_property
    def profiles(self) -> pd.DataFrame:
        """One row for each parameter and piece of its range: the best distance there."""
        return self._table(PROFILES)

    @cached_property
    def best_runs(self) -> pd.DataFrame:
        """What the data speak of, in runs with the values found on new seeds."""
        return self._table(BEST_RUNS)

    @cached_property
    def parameters(self) -> pd.DataFrame:
        """One row a parameter: what was found, its interval, and what recovery says of it."""
        import pandas as pd

        rows = []
        for name, value in self.values.items():
            low, high = self.best["intervals"][name] or (None, None)
            rows.append({"parameter": name, "found": value, "low": low, "high": high})
        frame = pd.DataFrame(rows).astype({"low": float, "high": float})
        if not self.manifest.recover:
            return frame.assign(verdict="not checked")
        return frame.merge(identifying.summary(self.recovery), on="parameter", how="left")

    def _table(self, name: str) -> pd.DataFrame:
        import pandas as pd

        path = self._capsule.table(name)
        if not path.is_file():
            raise SocialmindError(f"{path}: no such file; take it from a copy of the folder")
        return pd.read_parquet(path)

    def _repr_html_(self) -> str:
        from html import escape

        title = f"{self.manifest.model['name']}, fitted by {self.manifest.method}"
        table = self.parameters.to_html(index=False, float_format="{:.4g}".format, na_rep="")
        return f"<p><b>{escape(title)}</b></p>{table}<p>{escape(str(self.folder))}</p>"
