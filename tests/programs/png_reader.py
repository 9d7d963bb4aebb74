"""Reads PNG files of RGB without libpng: what MARS writes, and what others write of the same pixels."""

import struct
import zlib


def predicted(kind, left, above, corner):
    if kind == 4:
        p = left + above - corner
        return min((abs(p - left), 0, left), (abs(p - above), 1, above), (abs(p - corner), 2, corner))[2]
    return (0, left, above, (left + above) // 2)[kind]


def png_rows(path, depth=8):
    """Rows of bytes; of 16 bits a channel the higher byte first. It must have `depth` bits a channel."""
    data, at, packed = path.read_bytes(), 8, b""
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at:at + 8])
        chunk = data[at + 8:at + 8 + length]
        if kind == b"IHDR":
            width, height, *form = struct.unpack(">IIBB", chunk[:10])
            assert form == [depth, 2], form
        packed += chunk if kind == b"IDAT" else b""
        at += 12 + length
    pixel = 3 * depth // 8
    raw, size, rows = zlib.decompress(packed), pixel * width, []
    above = bytes(size)
    for y in range(height):
        kind, *line = raw[y * (size + 1):(y + 1) * (size + 1)]
        if kind == 2:
            line = [(a + b) & 255 for a, b in zip(line, above)]
        elif kind != 0:
            for x in range(size):
                left, corner = (line[x - pixel], above[x - pixel]) if x >= pixel else (0, 0)
                line[x] = (line[x] + predicted(kind, left, above[x], corner)) & 255
        above = bytes(line)
        rows.append(above)
    return rows
