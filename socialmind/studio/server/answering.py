"""Routes that plain functions answer: JSON in, JSON out, and what is wrong in one sentence."""

from __future__ import annotations

import json
from collections.abc import Callable
from typing import Any

from starlette.concurrency import run_in_threadpool
from starlette.requests import Request
from starlette.responses import JSONResponse

from coglogo_py import CogLogoError
from socialmind.errors import SocialmindError

Asked = dict[str, Any]


class OtherFileError(SocialmindError):
    """Where something is to be saved stands another than what was opened."""


def answering(do: Callable[[Asked], Any]) -> Callable[[Request], Any]:
    """Return what answers a page by a function, outside the loop that serves all pages.

    Args:
        do: takes what is asked, in the query or as a JSON object, and returns JSON. Its errors of
            users are answered as ``{"error": …}``, with ``"exists"`` where a file is in the way.
    """

    async def answer(request: Request) -> JSONResponse:
        try:
            asked = json.loads(await request.body() or b"{}")
            if not isinstance(asked, dict):
                raise SocialmindError("expected a JSON object")
            return JSONResponse(await run_in_threadpool(do, {**request.query_params, **asked}))
        except OtherFileError as error:
            return JSONResponse({"error": str(error), "exists": True}, 400)
        except (SocialmindError, CogLogoError, OSError, ValueError) as error:
            return JSONResponse({"error": str(error)}, 400)

    return answer
