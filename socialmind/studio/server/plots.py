"""Panels of plots as files: the numbers come from the societies' processes, and are drawn here."""

from __future__ import annotations

import asyncio
import json
from collections.abc import Mapping
from typing import Any

from starlette.requests import Request
from starlette.responses import JSONResponse, Response
from starlette.routing import Route

from socialmind.errors import SocialmindError
from socialmind.studio.server.stages import StageProcess

TYPES = {"pdf": "application/pdf", "svg": "image/svg+xml", "csv": "text/csv; charset=utf-8"}


def routes(stages: Mapping[str, StageProcess]) -> list[Route]:
    """Return what answers of plots.

    Args:
        stages: the societies that run, by name.
    """

    async def plot(request: Request) -> Response:
        form, query = request.path_params["form"], request.query_params
        try:
            if form not in TYPES:
                raise SocialmindError(f"no plots as {form}; there is {', '.join(TYPES)}")
            panel = _panel(query.get("panel", ""))
            names = [one for one in query.get("worlds", "").split(",") if one in stages]
            if not names:
                raise SocialmindError("no such society runs")
            asked = {"do": "table", "panel": panel}
            tables = await asyncio.gather(*(stages[one].answer(asked, "table") for one in names))
            content = await asyncio.to_thread(_written, panel, tables, form)
        except SocialmindError as error:
            return JSONResponse({"error": str(error)}, 400)
        name = f"{tables[0]['model']}-{panel['kind']}-{tables[0]['tick']}.{form}"
        headers = {"content-disposition": f'attachment; filename="{name}"'}
        return Response(content, media_type=TYPES[form], headers=headers)

    return [Route("/api/plot.{form}", plot)]


def _panel(text: str) -> dict[str, Any]:
    try:
        panel = json.loads(text)
        kind = panel["kind"]
    except (ValueError, TypeError, KeyError):
        raise SocialmindError(f"{text[:80]!r} says no panel") from None
    if kind not in ("series", "histogram", "scatter"):
        raise SocialmindError(f"no panel of the kind {kind!r}")
    return dict(panel)


def _written(panel: Mapping[str, Any], tables: list[dict[str, Any]], form: str) -> bytes:
    from socialmind.studio.plots.figure import Drawn, figure_of
    from socialmind.studio.plots.table import csv_of

    societies = [
        Drawn(one["columns"], f"{place}. {one['model'].replace('_', ' ')}", one["units"])
        for place, one in enumerate(tables, 1)
    ]
    if not any(len(column) for column in societies[0].columns.values()):
        raise SocialmindError("there is nothing to plot yet")
    return csv_of(societies) if form == "csv" else figure_of(panel["kind"], societies, form)
