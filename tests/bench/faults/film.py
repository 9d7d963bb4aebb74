"""The film that is rendered while machines fail: a field of bodies, of which a fifth turns in each interval while the
others stand still. A frame is the same however long the film is."""
import json

PARTS = 5
COLUMNS, ROWS = 8, 5
INTERVAL = 24  # frames
SHAPES = ("sphere", "teapot", "torus", "capsule", "rounded_box")
COLORS = ([0.85, 0.45, 0.3], [0.3, 0.55, 0.8], [0.55, 0.7, 0.35], [0.8, 0.7, 0.3], [0.6, 0.45, 0.7])


def body(column, row):
    """A joint that turns about the vertical, with its shape."""
    return {"name": f"{column}-{row}", "place": [column - (COLUMNS - 1) / 2, 0, row - (ROWS - 1) / 2],
            "limits": {"z": [-1e6, 1e6]},
            "segment": {"shape": SHAPES[(column + row) % len(SHAPES)], "sbb": [[-0.4, -0.4, -0.4], [0.4, 0.4, 0.4]]}}


def part_of(column, row):
    return (column + 2 * row) % PARTS


def keys_of(part, joints, frames):
    """In every fifth interval from its own on it turns by a right angle."""
    keys, angle = [], 0
    for first in range(part * INTERVAL, frames, PARTS * INTERVAL):
        for frame, turned in ((first, angle), (first + INTERVAL, angle + 90)):
            keys.append({"frame": frame, "pose": {joint["name"]: [0, 0, turned] for joint in joints}})
        angle += 90
    return keys


def film_of(frames, size, dice):
    joints = [[] for _ in range(PARTS)]
    for row in range(ROWS):
        for column in range(COLUMNS):
            joints[part_of(column, row)].append(body(column, row))
    return {
        "frames": frames, "rate": 24, "size": size, "samples": 4, "dice": dice, "background": [0.07, 0.09, 0.13],
        "camera": {"eye": [0, -14, 2], "at": [0, 0, 0], "fov": 24},
        "materials": {f"glaze-{part}": {"color": COLORS[part]} for part in range(PARTS)},
        "models": {f"part-{part}": {"joints": joints[part]} for part in range(PARTS)},
        "actors": [{"name": f"part-{part}", "model": f"part-{part}", "material": f"glaze-{part}",
                    **({"keys": keys} if (keys := keys_of(part, joints[part], frames)) else {})}
                   for part in range(PARTS)],
    }


def write_film(path, frames, size=(480, 270), dice=16):
    path.write_text(json.dumps(film_of(frames, list(size), dice)) + "\n")
    return path
