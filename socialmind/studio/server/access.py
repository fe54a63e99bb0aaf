"""Who may ask the studio: pages of its own alone, from this machine unless a token is shown.

Every user of a machine reaches its own address. So what lets somebody run programs as the user who
began the studio asks for the token there too.
"""

from __future__ import annotations

import hmac
import secrets
from collections.abc import Awaitable, Callable, Collection, MutableMapping
from http.cookies import SimpleCookie
from typing import Any
from urllib.parse import parse_qs

Scope = MutableMapping[str, Any]
Receive = Callable[[], Awaitable[Any]]
Send = Callable[[Any], Awaitable[None]]
App = Callable[[Scope, Receive, Send], Awaitable[None]]

LOOPBACK = ("127.0.0.1", "localhost", "[::1]")
COOKIE = "socialmind_token"


def new_token() -> str:
    """Return a token that cannot be guessed."""
    return secrets.token_urlsafe(24)


class Guarded:
    """An application that answers only who may ask.

    A name that leads to this machine from elsewhere (DNS rebinding) is refused by the Host header,
    a page of another site by the Origin, a websocket too.

    Args:
        app: what answers.
        hosts: names and addresses under which it is asked, without a port.
        token: what must be shown, once as ``?token=`` and from then on as a cookie; None for none.
        only: the paths for which it must be; None for all.
    """

    def __init__(
        self,
        app: App,
        hosts: tuple[str, ...],
        token: str | None = None,
        only: Collection[str] | None = None,
    ) -> None:
        self._app = app
        self._hosts = hosts
        self._token = token
        self._only = only

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer, or refuse."""
        if scope["type"] not in ("http", "websocket"):
            await self._app(scope, receive, send)
            return
        refusal = self._refusal(scope)
        if refusal is not None:
            await _refuse(scope, send, refusal)
            return
        await self._app(scope, receive, self._with_cookie(scope, send))

    def _refusal(self, scope: Scope) -> str | None:
        headers = {name.decode("latin-1"): one.decode("latin-1") for name, one in scope["headers"]}
        host = headers.get("host", "")
        if _without_port(host) not in self._hosts:
            return "asked under another name than this machine's"
        origin = headers.get("origin")
        if origin is not None and origin.partition("://")[2] != host:
            return "asked by a page of another site"
        if scope["type"] == "websocket" and origin is None:
            return "asked by no page"
        needed = self._token is not None and (self._only is None or scope["path"] in self._only)
        if needed and not self._shows_token(scope, headers):
            return "asked without the token that stands in the address that the program printed"
        return None

    def _shows_token(self, scope: Scope, headers: dict[str, str]) -> bool:
        cookie = SimpleCookie(headers.get("cookie", "")).get(_cookie_at(headers.get("host", "")))
        shown = [cookie.value] if cookie is not None else []
        shown += parse_qs(scope.get("query_string", b"").decode("latin-1")).get("token", [])
        return any(hmac.compare_digest(one, self._token or "") for one in shown)

    def _with_cookie(self, scope: Scope, send: Send) -> Send:
        """Let a page that has shown the token show it again by itself."""
        headers = {name.decode("latin-1"): one.decode("latin-1") for name, one in scope["headers"]}
        if self._token is None or scope["type"] != "http" or not self._shows_token(scope, headers):
            return send
        name = _cookie_at(headers.get("host", ""))
        cookie = f"{name}={self._token}; HttpOnly; SameSite=Strict; Path=/"

        async def sending(message: Any) -> None:
            if message["type"] == "http.response.start":
                headers = [*message.get("headers", []), (b"set-cookie", cookie.encode())]
                message = {**message, "headers": headers}
            await send(message)

        return sending


def _cookie_at(host: str) -> str:
    """Return the name of the cookie: browsers give those of all ports of a machine to each."""
    _, colon, port = host.rpartition(":")
    return f"{COOKIE}_{port}" if colon and port.isdecimal() else COOKIE


def _without_port(host: str) -> str:
    name, colon, port = host.rpartition(":")
    return name if colon and port.isdecimal() else host


async def _refuse(scope: Scope, send: Send, why: str) -> None:
    if scope["type"] == "websocket":
        await send({"type": "websocket.close", "code": 1008, "reason": why})
        return
    content = f"socialmind studio: refused: {why}\n".encode()
    headers = [(b"content-type", b"text/plain; charset=utf-8")]
    await send({"type": "http.response.start", "status": 403, "headers": headers})
    await send({"type": "http.response.body", "body": content})
