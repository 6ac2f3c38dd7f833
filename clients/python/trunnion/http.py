# SPDX-License-Identifier: Apache-2.0
"""Requests to the gateway. A refusal is an exception with the cluster's reason."""
from __future__ import annotations

import http.client
import json
import ssl
import urllib.parse
from typing import Any

from .errors import NotConnected, Refused


class Http:
    """One gateway. Every request has a connection of its own, so any thread may call."""

    def __init__(self, url: str, timeout: float = 10.0, token: str | None = None, ca: str | None = None):
        """url: for example http://localhost:8080 or https://mill-3:8080; timeout: seconds to wait for an answer.

        token: of `trunnion user token`, for a machine whose users log in. ca: PEM file with the certificate that is trusted, of
        `trunnion certificate`; without it those that the system trusts.
        """
        parts = urllib.parse.urlsplit(url if "//" in url else f"//{url}", scheme="http")
        if parts.scheme not in ("http", "https") or not parts.hostname:
            raise ValueError(f"{url}: not a URL of the form http://HOST:PORT or https://HOST:PORT")
        secure = parts.scheme == "https"
        if ca is not None and not secure:
            raise ValueError(f"{url}: a certificate is checked only with https://")
        try:
            #: Of https, None without.
            self.tls = ssl.create_default_context(cafile=ca) if secure else None
        except OSError as error:
            raise ValueError(f"{ca}: no certificates in PEM form: {error}") from error
        self.host, self.port, self.timeout = parts.hostname, parts.port or (443 if secure else 80), timeout
        self.url = f"{parts.scheme}://{self.host}:{self.port}"
        #: The sequence of the stream from which on the state is not older than the newest answer.
        self.shown = 0
        #: Headers of every request.
        self.headers = {"Authorization": f"Bearer {token}"} if token else {}

    def request(self, method: str, path: str, body: bytes | None = None, kind: str = "application/json",
                headers: dict[str, str] | None = None) -> bytes:
        """The body of the answer. Raises Refused or NotConnected."""
        sent = {**self.headers, **(headers or {}), **({"Content-Type": kind} if body is not None else {})}
        connection = self._connection()
        try:
            connection.request(method, path, body, sent)
            answer = connection.getresponse()
            content = answer.read()
            self.shown = max(self.shown, int(answer.headers.get("X-State-Sequence") or 0))
        except (OSError, http.client.HTTPException) as error:
            raise NotConnected(f"{self.url} does not answer: {error}") from error
        finally:
            connection.close()
        if 200 <= answer.status < 300:
            return content
        try:
            refusal = json.loads(content)
        except ValueError:
            refusal = {}
        if not isinstance(refusal, dict):
            refusal = {}
        reason = refusal.get("reason") or refusal.get("error") or refusal.get("detail") or f"the gateway answered {answer.status}"
        raise Refused(str(reason), answer.status, int(refusal.get("alarm") or 0))

    def _connection(self) -> http.client.HTTPConnection:
        if self.tls is None:
            return http.client.HTTPConnection(self.host, self.port, timeout=self.timeout)
        return http.client.HTTPSConnection(self.host, self.port, timeout=self.timeout, context=self.tls)

    def get(self, path: str) -> Any:
        """JSON of a GET."""
        return json.loads(self.request("GET", path))

    def send(self, method: str, path: str, body: dict[str, Any] | None = None) -> Any:
        """JSON of the answer to a POST, PUT or DELETE with a JSON body."""
        content = None if method == "DELETE" else json.dumps(body or {}).encode()
        return json.loads(self.request(method, path, content) or b"{}")
