"""The large film: 10^7 polygons at 3840x2160, 2000 frames in 60 intervals, in each of which another twentieth moves."""
import json
import math

PARTS = 20  # of the bodies, of which one moves at a time
PATCHES = 32  # of a sphere, each of 2 dice^2 polygons


class Size:
    """How much there is of everything."""

    def __init__(self, columns, rows, dice, picture, frames, intervals):
        self.columns, self.rows, self.dice = columns, rows, dice
        self.picture, self.frames, self.intervals = picture, frames, intervals

    def polygons(self):
        return self.columns * self.rows * PATCHES * 2 * self.dice ** 2

    def first_frames(self):
        return [k * self.frames // self.intervals for k in range(self.intervals + 1)]


WHOLE = Size(40, 27, 12, [3840, 2160], 2000, 60)
HALF = Size(40, 27, 6, [1920, 1080], 2000, 60)  # a quarter of the polygons and pixels
SMALL = Size(20, 11, 3, [384, 216], 60, 12)

SIZES = {"whole": WHOLE, "half": HALF, "small": SMALL}


def part_of(column, row):
    return (column + 7 * row) % PARTS


def body(column, row, size):
    """A joint with its sphere, which fills most of its place."""
    x, z = column - (size.columns - 1) / 2, row - (size.rows - 1) / 2
    radius = 0.36 + 0.08 * ((3 * column + 5 * row) % 7) / 6
    return {"name": f"{column}-{row}", "place": [x, 0, z], "limits": {},
            "segment": {"shape": "sphere", "sbb": [[-radius] * 3, [radius] * 3]}}


def keys_of(part, size):
    """It moves to and fro, in every twentieth interval from its own on."""
    firsts, place, keys = size.first_frames(), 0.0, []
    for k in range(part, size.intervals, PARTS):
        keys.append({"frame": firsts[k], "place": [place, 0, 0]})
        place = 0.25 - place
        keys.append({"frame": firsts[k + 1], "place": [place, 0, 0]})
    return keys


def film_of(size):
    bodies = [[] for _ in range(PARTS)]
    for row in range(size.rows):
        for column in range(size.columns):
            bodies[part_of(column, row)].append(body(column, row, size))
    shades = [[round(0.5 + 0.4 * math.sin(part + turn), 3) for turn in (0, 2, 4)] for part in range(PARTS)]
    distance = size.rows / 2 / math.tan(math.radians(15.2))
    return {
        "frames": size.frames, "rate": 24, "size": size.picture, "color": "coded", "samples": 1, "dice": size.dice,
        "intervals": "keyframes",
        "camera": {"eye": [0, -distance, 0], "at": [0, 0, 0], "fov": 31},
        "lights": [{"direction": [-0.4, -0.7, 0.8]}],
        "materials": {f"glaze-{part}": {"color": shades[part]} for part in range(PARTS)},
        "models": {f"part-{part}": {"joints": bodies[part]} for part in range(PARTS)},
        "actors": [{"name": f"part-{part}", "model": f"part-{part}", "material": f"glaze-{part}",
                    **({"keys": keys_of(part, size)} if keys_of(part, size) else {})} for part in range(PARTS)],
    }


def write_film(path, size):
    path.write_text(json.dumps(film_of(size)) + "\n")
