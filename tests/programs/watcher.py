"""A watcher of a rendering, for tests: listens at a socket and puts together what the host says
(host/render/pictures/messages.h). Reads frames' PNG files."""

import pathlib
import socket
import struct
import threading
import time
import types

BEGIN, PICTURE, DRAWN = 5, 6, 8
HEAD = struct.Struct("<4IQ")
PICTURE_HEAD = struct.Struct("<10Id")
DRAWN_HEAD = struct.Struct("<6I3d")
PART = struct.Struct("<i3I13d3Q")
NOTHING, STILL, MOVING, UNKNOWN = range(4)


class Watcher:
    """`seen(self)` is called after each picture, on a thread of its own; `rest`: seconds between two messages."""

    def __init__(self, path, seen=lambda watcher: None, rest=0.0, last=None):
        self.seen, self.rest, self.last = seen, rest, last
        self.begun = []   # (width, height, block, groups, frames, nodes)
        self.drawn = {}   # frame: (interval, kind, group, parts)
        self.pictures = 0
        self.failure = None
        self.listener = socket.socket(socket.AF_UNIX)
        pathlib.Path(path).unlink(missing_ok=True)  # of a watcher before
        self.listener.bind(str(path))
        self.listener.listen(1)
        self.thread = threading.Thread(target=self.work, daemon=True)  # no host may come
        self.thread.start()

    def work(self):
        try:
            self.stream, _ = self.listener.accept()
            with self.stream:
                while self.last is None or self.pictures < self.last:
                    if not self.take():
                        break
                    time.sleep(self.rest)
            self.listener.close()
        except Exception as failure:  # shown by end()
            self.failure = failure

    def has_waited_in_vain(self):
        """Whether no host has come: all frames were there."""
        return not self.begun and self.thread.is_alive()

    def end(self):
        self.thread.join()
        if self.failure:
            raise self.failure

    def read(self, size):
        data = bytearray()
        while len(data) < size:
            piece = self.stream.recv(size - len(data))
            if not piece:
                return None
            data += piece
        return bytes(data)

    def take(self):
        head = self.read(HEAD.size)
        if head is None:
            return False
        kind, _, _, _, size = HEAD.unpack(head)
        body = self.read(size)
        if body is None:
            return False
        {BEGIN: self.take_begin, PICTURE: self.take_picture, DRAWN: self.take_drawn}[kind](body)
        return True

    def take_begin(self, body):
        self.begun.append(struct.unpack_from("<6I", body))
        self.width, self.height = self.begun[-1][:2]
        self.hosts = [body[24 + 68 * i + 4:24 + 68 * (i + 1)].split(b"\0")[0].decode()
                      for i in range(self.begun[-1][5])]
        self.rows = [bytearray(4 * self.width) for _ in range(self.height)]

    def take_picture(self, body):
        width, height, rects, lines, self.frame, self.interval, self.kind, self.whole, self.group, _, self.seconds = \
            PICTURE_HEAD.unpack_from(body)
        assert (width, height, lines) == (self.width, self.height, self.height)
        at = PICTURE_HEAD.size
        self.rects = [struct.unpack_from("<4H", body, at + 8 * i) for i in range(rects)]
        at += 8 * rects
        self.lines = [struct.unpack_from("<iI", body, at + 8 * i) for i in range(self.height)]
        at += 8 * self.height
        for x, y, width, height in self.rects:
            for line in range(y, y + height):
                self.rows[line][4 * x:4 * (x + width)] = body[at:at + 4 * width]
                at += 4 * width
        assert at == len(body)
        self.pictures += 1
        self.seen(self)

    def take_drawn(self, body):
        frame, interval, kind, group, parts, _, given, seconds, ratio = DRAWN_HEAD.unpack_from(body)
        self.drawn[frame] = (interval, kind, group,
                             [PART.unpack_from(body, DRAWN_HEAD.size + PART.size * i) for i in range(parts)])

    def copy(self):
        """What it has now; rows of `colors` are red, green, blue."""
        return types.SimpleNamespace(frame=self.frame, interval=self.interval, kind=self.kind, whole=self.whole,
                                     lines=self.lines, rects=self.rects, colors=self.colors(), marks=self.marks())

    def colors(self):
        rows = []
        for row in self.rows:
            colors = bytearray(3 * self.width)
            for channel in range(3):
                colors[channel::3] = row[channel::4]
            rows.append(bytes(colors))
        return rows

    def marks(self):
        return [bytes(row[3::4]) for row in self.rows]
