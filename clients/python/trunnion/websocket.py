# SPDX-License-Identifier: Apache-2.0
"""A WebSocket client for text messages (RFC 6455), as small as the gateway's stream permits."""
from __future__ import annotations

import base64
import hashlib
import os
import socket
import ssl
import struct

from .errors import NotConnected

_MAGIC = "258EAFA5-E914-47DA-95CA-C5AB0DC85B11"
_CONTINUED, _TEXT, _CLOSE, _PING, _PONG = 0, 1, 8, 9, 10
LONGEST_MESSAGE = 64 << 20  # bytes


def frame(opcode: int, payload: bytes, mask: bytes) -> bytes:
    """A final frame of a client, which is masked."""
    head = bytes([0x80 | opcode])
    if len(payload) < 126:
        head += bytes([0x80 | len(payload)])
    elif len(payload) < 1 << 16:
        head += struct.pack("!BH", 0x80 | 126, len(payload))
    else:
        head += struct.pack("!BQ", 0x80 | 127, len(payload))
    return head + mask + bytes(byte ^ mask[i % 4] for i, byte in enumerate(payload))


class Frames:
    """Bytes of a server in, whole messages out. Raises NotConnected on what RFC 6455 does not permit."""

    def __init__(self) -> None:
        self._bytes = bytearray()
        self._parts = bytearray()
        self._kind = 0

    def add(self, data: bytes) -> None:
        """What has been received."""
        self._bytes += data

    def next(self) -> tuple[int, bytes] | None:
        """Opcode and payload of the next message or control frame; None when more bytes are needed."""
        while True:
            one = self._next_frame()
            if one is None:
                return None
            final, opcode, payload = one
            if opcode >= _CLOSE:
                if not final or len(payload) > 125:
                    raise NotConnected("the gateway sent a control frame that is too long or split")
                return opcode, payload
            if (opcode == _CONTINUED) != (self._kind != 0):
                raise NotConnected("the gateway sent frames in the wrong order")
            self._kind = self._kind or opcode
            self._parts += payload
            if len(self._parts) > LONGEST_MESSAGE:
                raise NotConnected(f"the gateway sent a message of more than {LONGEST_MESSAGE} bytes")
            if final:
                kind, message = self._kind, bytes(self._parts)
                self._kind, self._parts = 0, bytearray()
                return kind, message

    def _next_frame(self) -> tuple[bool, int, bytes] | None:
        data = self._bytes
        if len(data) < 2:
            return None
        if data[0] & 0x70 or data[1] & 0x80:
            raise NotConnected("the gateway sent a frame with reserved bits or a mask")
        size, at = data[1] & 0x7F, 2
        if size >= 126:
            width = 2 if size == 126 else 8
            if len(data) < at + width:
                return None
            size, at = int.from_bytes(data[at : at + width], "big"), at + width
        if size > LONGEST_MESSAGE:
            raise NotConnected(f"the gateway sent a message of more than {LONGEST_MESSAGE} bytes")
        if len(data) < at + size:
            return None
        result = bool(data[0] & 0x80), data[0] & 0x0F, bytes(data[at : at + size])
        del data[: at + size]
        return result


class WebSocket:
    """An open connection. close() may be called from another thread than receive()."""

    def __init__(self, host: str, port: int, path: str, timeout: float, headers: dict[str, str] | None = None,
                 tls: ssl.SSLContext | None = None):
        """timeout: seconds; a silence of this length counts as a lost connection. tls: None for clear text."""
        try:
            self._socket = socket.create_connection((host, port), timeout)
            if tls is not None:
                self._socket = tls.wrap_socket(self._socket, server_hostname=host)
        except OSError as error:
            raise NotConnected(f"{'https' if tls else 'http'}://{host}:{port} does not answer: {error}") from error
        self._frames = Frames()
        try:
            self._open(host, port, path, headers or {})
        except BaseException:
            self._socket.close()
            raise

    def _open(self, host: str, port: int, path: str, headers: dict[str, str]) -> None:
        key = base64.b64encode(os.urandom(16)).decode()
        name = f"[{host}]" if ":" in host else host
        more = "".join(f"{header}: {value}\r\n" for header, value in headers.items())
        self._write(
            f"GET {path} HTTP/1.1\r\nHost: {name}:{port}\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
            f"Sec-WebSocket-Key: {key}\r\nSec-WebSocket-Version: 13\r\n{more}\r\n".encode()
        )
        head = b""
        while b"\r\n\r\n" not in head:
            if len(head) > 1 << 16:
                raise NotConnected("the gateway sent no end of its header")
            head += self._read()
        head, _, rest = head.partition(b"\r\n\r\n")
        lines = head.decode("latin-1").split("\r\n")
        fields = {name.strip().lower(): value.strip() for name, _, value in (line.partition(":") for line in lines[1:])}
        expected = base64.b64encode(hashlib.sha1((key + _MAGIC).encode()).digest()).decode()
        if " 308 " in f"{lines[0]} ":
            raise NotConnected("this gateway is reached by https:// only")
        if " 101 " not in f"{lines[0]} " or fields.get("sec-websocket-accept") != expected:
            raise NotConnected(f"the gateway opened no stream: {lines[0]}")
        self._frames.add(rest)

    def receive(self) -> str:
        """The next text message; answers pings. Raises NotConnected when the connection has ended."""
        while True:
            message = self._frames.next()
            if message is None:
                self._frames.add(self._read())
                continue
            opcode, payload = message
            if opcode == _TEXT:
                return payload.decode()
            if opcode == _PING:
                self._write(frame(_PONG, payload, os.urandom(4)))
            if opcode == _CLOSE:
                raise NotConnected("the gateway has closed the stream")

    def close(self) -> None:
        """Ends the connection; receive() in another thread then raises NotConnected."""
        try:
            # Of the socket itself: that of TLS would let the other thread read what is encrypted as if it were not.
            socket.socket.shutdown(self._socket, socket.SHUT_RDWR)
        except OSError:
            pass
        self._socket.close()

    def _read(self) -> bytes:
        try:
            data = self._socket.recv(1 << 16)
        except OSError as error:
            raise NotConnected(f"the stream of the gateway is lost: {error}") from error
        if not data:
            raise NotConnected("the gateway has closed the stream")
        return data

    def _write(self, data: bytes) -> None:
        try:
            self._socket.sendall(data)
        except OSError as error:
            raise NotConnected(f"the stream of the gateway is lost: {error}") from error
