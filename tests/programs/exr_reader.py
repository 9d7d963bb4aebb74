"""EXR files without compression, read by the format's specification alone (openexr.com, "OpenEXR File Layout")."""

import pathlib
import struct


def floats_of(data, kind):
    return list(struct.unpack(f"<{len(data) // (2 if kind == 1 else 4)}{'Ief'[kind]}", data))


class Exr:
    """Attributes by name, as bytes; channels by name, each a list of lines of numbers."""

    def __init__(self, path):
        self.data = pathlib.Path(path).read_bytes()
        assert self.data[:4] == b"\x76\x2f\x31\x01", f"{path} is no EXR file"
        self.at = 8
        self.attributes, self.types = {}, {}
        while name := self.text():
            self.types[name] = self.text()
            size, = self.numbers("<i")
            self.attributes[name] = self.take(size)
        assert self.attributes["compression"] == b"\0", "compressed"
        left, top, right, bottom = struct.unpack("<4i", self.attributes["dataWindow"])
        self.width, self.height = right - left + 1, bottom - top + 1
        kinds = self.channel_kinds()
        self.channels = {name: [None] * self.height for name in kinds}
        for place in self.numbers(f"<{self.height}Q"):
            self.at = place
            line, _ = self.numbers("<ii")
            for name, kind in kinds.items():
                self.channels[name][line - top] = floats_of(self.take(self.width * (2 if kind == 1 else 4)), kind)

    def take(self, size):
        self.at += size
        return self.data[self.at - size:self.at]

    def text(self):
        end = self.data.index(b"\0", self.at)
        return self.take(end + 1 - self.at)[:-1].decode()

    def numbers(self, form):
        return struct.unpack(form, self.take(struct.calcsize(form)))

    def string(self, name):
        return self.attributes[name].decode()

    def channel_kinds(self):
        rest, kinds = self.attributes["channels"], {}
        while rest != b"\0":
            name, rest = rest.split(b"\0", 1)
            kinds[name.decode()], = struct.unpack("<i", rest[:4])
            rest = rest[16:]
        return kinds

    def pixel(self, prefix, names, x, y):
        return [self.channels[prefix + name][y][x] for name in names]
