# SPDX-License-Identifier: Apache-2.0
"""The state of the cluster as the gateway streams it, up to 20 times a second."""
from __future__ import annotations

import json
import threading
import time
from collections.abc import Callable
from typing import Any

from .errors import NotConnected, TimedOut
from .http import Http
from .websocket import WebSocket

SILENCE = 5.0  # s; the gateway sends something at least every 0.6 s


def merge_patch(target: Any, patch: Any) -> Any:
    """JSON Merge Patch (RFC 7396); the target is not modified, unchanged parts are shared."""
    if not isinstance(patch, dict):
        return patch
    merged = dict(target) if isinstance(target, dict) else {}
    for name, value in patch.items():
        if value is None:
            merged.pop(name, None)
        else:
            merged[name] = merge_patch(merged.get(name), value)
    return merged


class Stream:
    """Follows the state in a thread of its own until close()."""

    def __init__(self, http: Http):
        self._http = http
        http.shown = 0  # another gateway counts anew
        self._socket = WebSocket(http.host, http.port, "/api/stream", SILENCE, http.headers, http.tls)
        self._changed = threading.Condition()
        self._state: dict[str, Any] = {}
        self._sequence = -1
        self._count = 0
        self._error: NotConnected | None = None
        self._listeners: list[Callable[[dict[str, Any]], None]] = []
        self._thread = threading.Thread(target=self._run, name="trunnion stream", daemon=True)
        self._thread.start()
        self.wait(lambda state: True, 10.0)

    @property
    def state(self) -> dict[str, Any]:
        """The newest state (MachineState of the API), never older than the newest answer; it is not modified later.

        Raises NotConnected when it is lost.
        """
        return self.wait(lambda state: state, 10.0)

    def wait(self, condition: Callable[[dict[str, Any]], Any], timeout: float) -> Any:
        """The first true result of `condition` for the newest state and those after it.

        timeout: seconds. Raises TimedOut, NotConnected, or what the condition raises.
        """
        until = time.monotonic() + timeout
        with self._changed:
            while True:
                self._check()
                shown = self._count and self._sequence >= self._http.shown
                result = condition(self._state) if shown else None
                if result:
                    return result
                left = until - time.monotonic()
                if left <= 0:
                    raise TimedOut(f"not within {timeout:g} s")
                self._changed.wait(left)

    def listen(self, listener: Callable[[dict[str, Any]], None]) -> None:
        """Calls the listener for every message from now on, in the thread of the stream; it must not wait."""
        with self._changed:
            self._listeners = [*self._listeners, listener]

    def forget(self, listener: Callable[[dict[str, Any]], None]) -> None:
        """Ends listen()."""
        with self._changed:
            self._listeners = [one for one in self._listeners if one != listener]

    def close(self) -> None:
        """Ends the connection and the thread."""
        self._socket.close()
        if self._thread is not threading.current_thread():
            self._thread.join(5.0)

    def _check(self) -> None:
        if self._error:
            raise NotConnected(str(self._error))

    def _run(self) -> None:
        try:
            while True:
                self._take(json.loads(self._socket.receive()))
        except NotConnected as error:
            lost = error
        except Exception as error:  # a listener or a message that is no JSON: the waiting threads must learn it
            lost = NotConnected(f"the stream has ended: {error}")
        with self._changed:
            self._error = lost
            self._changed.notify_all()

    def _take(self, message: dict[str, Any]) -> None:
        if "state" not in message and "changes" not in message:
            return
        with self._changed:
            if "state" in message:
                self._state = message["state"]
            elif message["since"] == self._sequence:
                self._state = merge_patch(self._state, message["changes"])
            else:
                raise NotConnected("a message of the stream is missing")
            self._sequence = message["sequence"]
            self._count += 1
            listeners, state = self._listeners, self._state
            self._changed.notify_all()
        for listener in listeners:
            listener(state)
