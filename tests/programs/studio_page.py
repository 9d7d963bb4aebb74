"""A page of the studio, by hand: HTTP and WebSockets over plain sockets, so that tests can also say what no browser
would."""

import base64
import json
import os
import socket
import ssl
import struct
import urllib.parse

SECONDS = 120  # for whatever the studio must say


def connect(link):
    """A socket to where the link leads, with TLS where it asks for it."""
    where = urllib.parse.urlsplit(link)
    connection = socket.create_connection((where.hostname, where.port), SECONDS)
    if where.scheme == "https":
        context = ssl.create_default_context()
        context.check_hostname = False
        context.verify_mode = ssl.CERT_NONE
        connection = context.wrap_socket(connection)
    return connection


def read_head(stream):
    status = int(stream.readline().split()[1])
    headers = {}
    while (line := stream.readline().strip()):
        name, _, value = line.decode().partition(":")
        headers[name.lower()] = value.strip()
    return status, headers


def request(link, target="/", method="GET", **headers):
    """The answer's status, headers and body. Host is the link's, unless one is given."""
    with connect(link) as connection:
        fields = {"Host": urllib.parse.urlsplit(link).netloc, **headers}
        lines = [f"{method} {target} HTTP/1.1"] + [f"{name.replace('_', '-')}: {value}" for name, value in fields.items()]
        connection.sendall(("\r\n".join(lines) + "\r\n\r\n").encode())
        with connection.makefile("rb") as stream:
            status, answered = read_head(stream)
            length = 0 if method == "HEAD" else int(answered.get("content-length", 0))
            return status, answered, stream.read(length)


class Refused(Exception):
    """The WebSocket was: the status."""


class Page:
    def __init__(self, link, token=None, **headers):
        where = urllib.parse.urlsplit(link)
        token = urllib.parse.parse_qs(where.query)["token"][0] if token is None else token
        fields = {"Host": where.netloc, "Origin": f"{where.scheme}://{where.netloc}", "Upgrade": "websocket",
                  "Connection": "Upgrade", "Sec-WebSocket-Version": "13",
                  "Sec-WebSocket-Key": base64.b64encode(os.urandom(16)).decode(), **headers}
        self.socket = connect(link)
        lines = [f"GET /ws?token={token} HTTP/1.1"] + [f"{name}: {value}" for name, value in fields.items() if value]
        self.socket.sendall(("\r\n".join(lines) + "\r\n\r\n").encode())
        self.stream = self.socket.makefile("rb")
        status, _ = read_head(self.stream)
        if status != 101:
            self.close()
            raise Refused(status)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def close(self):
        self.stream.close()
        self.socket.close()

    def send_frame(self, kind, data, final=True):
        size = len(data)
        length = bytes([0x80 | size]) if size < 126 else (
            b"\xfe" + struct.pack(">H", size) if size < 65536 else b"\xff" + struct.pack(">Q", size))
        mask = os.urandom(4)
        masked = bytes(byte ^ mask[i % 4] for i, byte in enumerate(data))
        self.socket.sendall(bytes([(0x80 if final else 0) | kind]) + length + mask + masked)

    def say(self, **message):
        self.send_frame(1, json.dumps(message).encode())

    def frame(self):
        """Its kind (1 text, 2 binary, 8 close, 9 ping) and bytes; None where the connection ended."""
        try:
            head = self.stream.read(2)
            if len(head) < 2:
                return None
            size = head[1] & 127
            if size > 125:
                size = int.from_bytes(self.stream.read(2 if size == 126 else 8), "big")
            return head[0] & 15, self.stream.read(size)
        except (ConnectionError, ssl.SSLError):
            return None

    def hear(self, *kinds):
        """The next message: a text's object, a picture's bytes. Others than `kinds` are passed over."""
        while True:
            got = self.frame()
            assert got is not None, "the connection ended"
            message = json.loads(got[1]) if got[0] == 1 else got[1]
            name = {1: lambda: message["is"], 2: lambda: "picture", 8: lambda: "close"}.get(got[0], lambda: "")()
            if not kinds or name in kinds:
                return message

    def ending(self):
        """The close frame's code; None where the connection ended without one."""
        while (got := self.frame()) is not None:
            if got[0] == 8:
                return int.from_bytes(got[1][:2], "big")
        return None
