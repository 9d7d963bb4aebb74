"""Cryptomatte files decoded by the specification (github.com/Psyop/Cryptomatte, version 1.2.0) alone."""

import json
import struct


def murmur3_32(data, seed=0):
    """MurmurHash3_x86_32."""
    keep = 0xffffffff
    turn = lambda number, bits: (number << bits | number >> 32 - bits) & keep
    value = seed
    for at in range(0, len(data), 4):
        block = data[at:at + 4]
        mixed = turn(int.from_bytes(block, "little") * 0xcc9e2d51 & keep, 15) * 0x1b873593 & keep
        value ^= mixed
        if len(block) == 4:
            value = (turn(value, 13) * 5 + 0xe6546b64) & keep
    value ^= len(data)
    value = (value ^ value >> 16) * 0x85ebca6b & keep
    value = (value ^ value >> 13) * 0xc2b2ae35 & keep
    return value ^ value >> 16


def id_of(name):
    """The float that stands for a name: uint32_to_float32."""
    bits = murmur3_32(name.encode())
    if bits >> 23 & 255 in (0, 255):
        bits ^= 1 << 23
    return struct.unpack("<f", struct.pack("<I", bits))[0]


class Matte:
    """One layer of an Exr: by name, what share of each pixel shows it."""

    def __init__(self, exr, layer):
        key = f"cryptomatte/{murmur3_32(layer.encode()):08x}"[:len("cryptomatte/") + 7]
        assert exr.string(key + "/name") == layer
        assert exr.string(key + "/hash") == "MurmurHash3_32"
        assert exr.string(key + "/conversion") == "uint32_to_float32"
        self.names = json.loads(exr.string(key + "/manifest"))
        self.exr = exr
        self.layers = sorted({name[:-2] for name in exr.channels if name.startswith(layer) and name[len(layer)].isdigit()})

    def shares(self, x, y):
        """Name to share of pixel (x, y); every identity must be one of the manifest's."""
        known = {id_of(name): name for name in self.names}
        found = {}
        for layer in self.layers:
            red, green, blue, alpha = self.exr.pixel(layer + ".", "RGBA", x, y)
            for identity, share in ((red, green), (blue, alpha)):
                if share > 0:
                    found[known[identity]] = share
        return found
