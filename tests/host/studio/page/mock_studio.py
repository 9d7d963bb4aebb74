"""A studio for tests of the page: it serves the page's files, speaks docs/studio-protocol.md, notes what it hears, and
answers with pictures of plain colours. It takes Debian's python3-websockets."""

import asyncio
import base64
import concurrent.futures
import http
import json
import mimetypes
import pathlib
import socket
import struct
import threading
import urllib.parse
import zlib

import websockets
from websockets.connection import State

import settled

ROOT = pathlib.Path(__file__).resolve().parents[4]
PAGE = ROOT / "host/studio/page"
POLICY = "default-src 'self'"
TOKEN = "open-sesame"
RAW, DEFLATE, JPEG = 0, 1, 2
MOST_UNPAINTED = 2
FIRST_SCRIPT, SETTLED = b'<script type="module"', b'<script src="settled.js"></script>'
ANSWERED_BY_PICTURES = ("orbit", "preview", "drag", "frame", "commit", "drop")


def picture(view, number, edit, width, height, rects, pixels, encoding=RAW, flags=3):
    """A binary message; `pixels` are those of the rectangles in turn, or an encoded picture."""
    head = struct.pack("<IIIQHHHHI", 0x5352414D, view, number, edit, width, height, encoding, flags, len(rects))
    body = b"".join(struct.pack("<4H", *rect) for rect in rects)
    return head + body + (zlib.compress(pixels, 1) if encoding == DEFLATE else pixels)


def plain(width, height, color):
    return bytes((*color, 255)) * (width * height)


def kept_port():
    """A socket that keeps a port for this process, though nobody listens there at times: the socket never does, so that
    another of this address may."""
    keeper = socket.socket()
    keeper.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    keeper.bind(("127.0.0.1", 0))
    return keeper


class MockStudio:
    keeper = kept_port()  # one for all: then the browser keeps the page's files from one test to the next
    port = keeper.getsockname()[1]

    def __init__(self, project, draw=None, token=TOKEN):
        self.project = project
        self.token = token
        self.draw = draw or (lambda asked: plain(asked["width"], asked["height"], (40 + 30 * asked["view"], 60, 80)))
        self.there = lambda grab: {"joint": None, "handle": None}  # what a grab finds
        self.channels = []  # things with keys, as the protocol has them
        self.models = []    # that a film can have
        self.heard = []
        self.views = {}
        self.numbers = {}  # view -> its last picture
        self.painted = {}  # view -> the last that the page has painted
        self.due = {}      # view -> the edit of a picture for which there was no room
        self.page = None  # its socket
        self.news = threading.Condition()
        self.loop = asyncio.new_event_loop()

    # A test's side.

    def start(self):
        started = concurrent.futures.Future()
        threading.Thread(target=self._run, args=(started,), daemon=True).start()
        started.result(settled.PATIENCE)
        return self

    def stop(self):
        async def end():
            self.server.close()
            for idle in [each for each in self.server.websockets if each.state is State.CONNECTING]:
                idle.handler_task.cancel()  # a browser opens connections for which it has no use yet
                idle.transport.abort()
            await self.server.wait_closed()
        asyncio.run_coroutine_threadsafe(end(), self.loop).result(settled.PATIENCE)
        self.loop.call_soon_threadsafe(self.loop.stop)

    @property
    def link(self):
        return f"http://127.0.0.1:{self.port}/?token={self.token}"

    def forget(self):
        with self.news:
            self.heard.clear()

    def wait_for(self, does, count=1, **parts):
        """The first messages that do this and have these parts; fails where they do not come."""
        def found():
            return [each for each in self.heard if each.get("do") == does and parts.items() <= each.items()]
        with self.news:
            if not self.news.wait_for(lambda: len(found()) >= count, settled.PATIENCE):
                raise AssertionError(f"no message {does} with {parts} among {self.heard[-12:]}")
            return found()[-1]

    def tell(self, message):
        asyncio.run_coroutine_threadsafe(self._tell(message), self.loop).result(settled.PATIENCE)

    # Rectangles of a view, whose picture they follow.
    def show(self, view, rects, pixels, edit=0, encoding=RAW, size=None):
        self.numbers[view] = self.numbers.get(view, 0) + 1
        width, height = size or (self.views[view]["width"], self.views[view]["height"])
        self.tell(picture(view, self.numbers[view], edit, width, height, rects, pixels, encoding))
        return self.numbers[view]

    # A studio's side.

    def _run(self, started):
        asyncio.set_event_loop(self.loop)

        async def serve():
            self.server = await websockets.serve(self._page, "127.0.0.1", self.port, process_request=self._file, compression=None)

        try:
            started.set_result(self.loop.run_until_complete(serve()))
        except OSError as failure:
            started.set_exception(failure)
            return
        self.loop.run_forever()
        self.loop.close()

    async def _file(self, path, _):
        address = urllib.parse.urlsplit(path)
        if address.path == "/ws":
            right = urllib.parse.parse_qs(address.query).get("token") == [self.token]
            return None if right else (http.HTTPStatus.FORBIDDEN, [], b"")
        if address.path == "/settled.js":
            return http.HTTPStatus.OK, [("Content-Type", "text/javascript"), ("Cache-Control", "max-age=3600")], settled.SCRIPT.encode()
        file = (PAGE / address.path.lstrip("/")).resolve()
        file = file / "index.html" if file == PAGE else file
        if PAGE not in file.parents or not file.is_file():
            return http.HTTPStatus.NOT_FOUND, [], b""
        kind = "text/javascript" if file.suffix == ".js" else mimetypes.guess_type(file.name)[0]
        headers = [("Content-Type", kind), ("Content-Security-Policy", POLICY), ("Cache-Control", "max-age=3600")]
        return http.HTTPStatus.OK, headers, file.read_bytes().replace(FIRST_SCRIPT, SETTLED + FIRST_SCRIPT)

    async def _page(self, socket):
        if self.page:
            self.page.transport.abort()  # a page that was loaded again does not read on
        self.page = socket
        self.views.clear()
        self.numbers.clear()
        self.painted.clear()
        self.due.clear()
        try:
            await socket.send(json.dumps({"is": "project", **self.project}))
            await socket.send(json.dumps({"is": "state", "renderer": "", "nodes": 2, "machines": 1}))
            async for text in socket:
                await self._take(json.loads(text))
        except websockets.ConnectionClosed:
            pass
        finally:
            self.page = None if self.page is socket else self.page

    async def _take(self, message):
        does = message["do"]
        if does == "settled":  # settled.js, not the page
            return await self._tell({"is": "refused", "do": does})
        if does == "view":
            self.views[message["view"]] = message
            await self._picture(message["view"], message["edit"])
        elif does == "unview":
            for known in (self.views, self.numbers, self.painted, self.due):
                known.pop(message["view"], None)
        elif does == "painted":
            self.painted[message["view"]] = message["picture"]
            if message["view"] in self.due:
                await self._picture(message["view"], self.due.pop(message["view"]))
        elif does == "grab":
            await self._tell({"is": "grabbed", "view": message["view"], **self.there(message)})
        elif does == "models":
            await self._tell({"is": "models", "models": self.models})
        elif does == "channels":
            await self._tell({"is": "channels", "things": self.channels})
        elif does == "curves" and "parts" in message:
            await self._tell({"is": "curves", "thing": message["thing"], "first": 0, "parts": self._curves(message)})
        if does == "commit":
            self._commit(message["step"])
            if "commands" in message["step"]:
                await self._tell({"is": "done", "commands": message["step"]["commands"]})
            await self._tell({"is": "project", **self.project})
        if does in ANSWERED_BY_PICTURES:
            for view in list(self.views):
                await self._picture(view, message["edit"])
        with self.news:
            self.heard.append(message)
            self.news.notify_all()

    def _commit(self, step):
        self.project["undo"] = " ".join(step["commands"][0][:3]) if "commands" in step else "pose"
        for actor in self.project["actors"]:
            for joint in actor["joints"]:
                if joint["name"] in step.get("pose", {}):
                    joint["pose"] = step["pose"][joint["name"]]

    # Straight from a value to itself: flat curves at the first key's values.
    def _curves(self, asked):
        parts = [part for each in self.channels if each["thing"] == asked["thing"] for part in each["parts"]]
        return [{"name": part["name"], "axes": part["axes"], "limits": [[-90, 90]] * len(part["axes"]),
                 "values": [[value] * self.project["frames"] for value in part["keys"][0]["value"]]}
                for part in parts if part["name"] in asked["parts"]]

    async def _picture(self, view, edit):
        if self.numbers.get(view, 0) - self.painted.get(view, 0) >= MOST_UNPAINTED:
            self.due[view] = edit
            return
        asked = self.views[view]
        self.numbers[view] = self.numbers.get(view, 0) + 1
        rects = [(0, 0, asked["width"], asked["height"])]
        await self._tell(picture(view, self.numbers[view], edit, asked["width"], asked["height"], rects, self.draw(asked)))

    async def _tell(self, message):
        data = message if isinstance(message, bytes) else json.dumps(message)
        if self.page:
            await self.page.send(data)


def bits(flags):
    """Flags as the protocol has them: the lowest bit of a byte first, base64."""
    data = bytearray(-(-len(flags) // 8))
    for at, flag in enumerate(flags):
        data[at // 8] |= flag << at % 8
    return base64.b64encode(bytes(data)).decode()
