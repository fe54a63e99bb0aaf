"""Pages of the studio itself are answered, and nobody else."""

import asyncio
from http.cookies import SimpleCookie

import pytest

from socialmind.studio.server.access import COOKIE, LOOPBACK, Guarded

HOST = "127.0.0.1:8765"
HERE = f"http://{HOST}"


async def hello(scope, receive, send):
    if scope["type"] == "websocket":
        await send({"type": "websocket.accept"})
    else:
        await send({"type": "http.response.start", "status": 200, "headers": []})
        await send({"type": "http.response.body", "body": b"hello"})


def asked(kind, token=None, query="", path="/", only=None, **headers):
    """Ask a guarded application once; return what it sends."""
    sent = []

    async def send(message):
        sent.append(message)

    named = {"host": HOST, **headers}
    scope = {
        "type": kind,
        "path": path,
        "query_string": query.encode(),
        "headers": [(name.encode(), one.encode()) for name, one in named.items()],
    }
    asyncio.run(Guarded(hello, LOOPBACK, token, only)(scope, None, send))
    return sent


def status(**asking):
    return asked("http", **asking)[0]["status"]


def accepted(**asking):
    return asked("websocket", **asking)[0]["type"] == "websocket.accept"


@pytest.mark.parametrize("host", [HOST, "localhost:9000", "[::1]:8765", "localhost"])
def test_its_own_pages_are_answered(host):
    assert status(host=host) == 200
    assert status(host=host, origin=f"http://{host}") == 200
    assert accepted(host=host, origin=f"http://{host}")


@pytest.mark.parametrize(
    "host", ["evil.example", "evil.example:8765", "127.0.0.1.evil.example", ""]
)
def test_another_name_is_refused(host):
    assert status(host=host) == 403
    assert not accepted(host=host, origin=f"http://{host}")


@pytest.mark.parametrize(
    "origin", ["http://evil.example", "null", "http://127.0.0.1:9999", "http://localhost:8765", ""]
)
def test_pages_of_other_sites_are_refused(origin):
    assert status(origin=origin) == 403
    assert not accepted(origin=origin)


def test_a_websocket_without_an_origin_is_refused():
    assert not accepted()


def test_elsewhere_the_token_must_be_shown_once():
    assert status(token="secret") == 403
    assert status(token="secret", query="token=wrong") == 403
    assert not accepted(token="secret", origin=HERE)
    answer = asked("http", token="secret", query="token=secret")
    assert answer[0]["status"] == 200
    # Browsers send the cookies of one port of a machine to all: each studio has its own.
    named = f"{COOKIE}_8765"
    cookie = SimpleCookie(dict(answer[0]["headers"])[b"set-cookie"].decode())[named]
    assert (cookie["httponly"], cookie["samesite"]) == (True, "Strict")
    shown = f"{named}={cookie.value}"
    assert status(token="secret", cookie=shown) == 200
    assert accepted(token="secret", cookie=shown, origin=HERE)
    assert not accepted(token="secret", cookie=f"{named}=wrong", origin=HERE)


def test_here_it_must_be_shown_for_what_lets_programs_be_written_alone():
    asking = {"token": "secret", "only": ("/api/write",)}
    answer = asked("http", **asking)
    # Whoever has not shown it is not given it.
    assert (answer[0]["status"], answer[0]["headers"]) == (200, [])
    assert accepted(**asking, origin=HERE)
    assert status(**asking, path="/api/write") == 403
    assert status(**asking, path="/api/write", cookie=f"{COOKIE}_8765=wrong") == 403
    assert status(**asking, path="/api/write", cookie=f"{COOKIE}_8765=secret") == 200
    assert dict(asked("http", **asking, query="token=secret")[0]["headers"])[b"set-cookie"]
