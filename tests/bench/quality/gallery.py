#!/usr/bin/env python3
"""Makes the pictures of docs/gallery.md: gallery.py BUILD_FOLDER PICTURE_FOLDER.

Needs ./bootstrap bench, and ffmpeg."""
import json
import os
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.append(os.path.join(HERE, "..", "peers"))
import films  # noqa: E402
import quality  # noqa: E402

SIZE = [960, 540]
SAMPLES = [1, 4, 16]
LABEL = 24  # pixels, above each picture

# Name, film, frame, the part shown (x, y, side), and how often it is enlarged.
DETAILS = [
    ("face", "demo", 36, (424, 54, 58), 4), ("hand", "demo", 36, (362, 246, 58), 4),
    ("soles", "demo", 36, (470, 386, 58), 4), ("horizon", "demo", 36, (322, 188, 58), 4),
    ("rim", "demo", 36, (640, 150, 58), 4),
    ("zone-plate", "zone-plate", 3, (500, 18, 232), 1), ("fan", "fan", 3, (610, 150, 116), 2)]

REFLECTIONS = {
    "phong": {"reflection": "phong", "specular": 0.5, "exponent": 40},
    "blinn-phong": {"reflection": "blinn-phong", "specular": 0.5, "exponent": 160},
    "cook-torrance": {"reflection": "cook-torrance", "specular": 0.5, "roughness": 0.25},
    "metallic 0": {"reflection": "metallic-roughness", "metallic": 0, "roughness": 0.35},
    "metallic 1": {"reflection": "metallic-roughness", "metallic": 1, "roughness": 0.35}}
INTERPOLATIONS = ["flat", "gouraud", "phong"]
SUNS = [0, 2, 8, 30]  # degrees that they take up in the sky


def tile(number, label, part, scale):
    """A filter of ffmpeg's: the part of an input, enlarged without smoothing, beneath its label."""
    x, y, width, height = part
    text = f"drawtext=font='DejaVu Sans':fontsize=14:text='{label}':x=(w-text_w)/2:y=5"
    return (f"[{number}]crop={width}:{height}:{x}:{y},scale=iw*{scale}:ih*{scale}:flags=neighbor,"
            f"pad=iw+4:ih+{LABEL}+2:2:{LABEL}:white,{text}[t{number}]")


def sheet(out, columns, tiles, scale=1):
    """`tiles`: label, picture and the part of it that is shown: x, y, width, height; all of one size."""
    width, height = (side * scale + more for side, more in zip(tiles[0][2][2:], (4, LABEL + 2)))
    filters = [tile(k, label, part, scale) for k, (label, _, part) in enumerate(tiles)]
    places = "|".join(f"{k % columns * width}_{k // columns * height}" for k in range(len(tiles)))
    names = "".join(f"[t{k}]" for k in range(len(tiles)))
    inputs = [word for _, picture, _ in tiles for word in ("-i", picture)]
    quality.run(["ffmpeg", "-loglevel", "error", "-y", *inputs, "-filter_complex",
                 ";".join(filters + [f"{names}xstack=inputs={len(tiles)}:layout={places},format=rgb24"]),
                 "-frames:v", "1", out])


class Gallery:
    def __init__(self, build, out, folder):
        self.build, self.out, self.folder = build, out, folder

    def file(self, name):
        return os.path.join(self.out, name + ".png")

    def details(self):
        rendered = {}
        for name, film, frame, (x, y, side), scale in DETAILS:
            if (film, frame) not in rendered:
                rendered[film, frame] = self.compared(film, frame)
            tiles = [(label, picture, (x, y, side, side)) for label, picture in rendered[film, frame]]
            sheet(self.file(name), 4, tiles, scale)

    def compared(self, name, frame):
        film = quality.Film(self.build, name, SIZE, self.folder)
        pictures = [(f"{s} sample{'s' if s > 1 else ''}", film.render(s, [frame])[0]) for s in SAMPLES]
        return pictures + [("reference", film.references([frame])[0])]

    def render(self, name, film, frame=0):
        path, folder = os.path.join(self.folder, name + ".json"), os.path.join(self.folder, name)
        films.save(film, path)
        quality.run([os.path.join(self.build, "bin", "mars"), "render", path, "--backend", "threads", "--quiet",
                     "--samples", "16", "--frames", str(frame), "-o", folder, "--overwrite"])
        return os.path.join(folder, f"frame-{frame:04}.png")

    def models(self):
        side = 184
        tiles = []
        for interpolation in INTERPOLATIONS:
            for k, (reflection, keys) in enumerate(REFLECTIONS.items()):
                film = still_life(side, {**keys, "interpolation": interpolation})
                picture = self.render(f"{interpolation}-{k}", film)
                tiles.append((f"{interpolation}, {reflection}", picture, (0, 0, side, side)))
        sheet(self.file("models"), len(REFLECTIONS), tiles)

    def colors(self):
        self.two_demos("colors", {color: {"color": color} for color in ("coded", "linear")})

    def walk(self):
        sun, *others = demo()["lights"]
        self.two_demos("walk", {"no light casts shadows": {},
                                "the sun casts shadows": {"lights": [{**sun, "shadow": True}, *others]}})

    def two_demos(self, name, changes):
        """By label: what is changed in the demo."""
        pictures = [(label, self.render(f"{name}-{k}", {**demo(), "size": [480, 270], **changed}, 36))
                    for k, (label, changed) in enumerate(changes.items())]
        sheet(self.file(name), 2, [(label, picture, (0, 0, 480, 270)) for label, picture in pictures])

    def suns(self):
        side = 232
        pictures = [(f"size {size}", self.render(f"sun-{size}", ball_and_poles(side, size))) for size in SUNS]
        sheet(self.file("suns"), len(SUNS), [(label, picture, (0, 0, side, side)) for label, picture in pictures])


def demo():
    with open(os.path.join(films.EXAMPLES, "demo.json")) as file:
        film = json.load(file)
    film["models"] = {name: os.path.join(films.EXAMPLES, model) if isinstance(model, str) else model
                      for name, model in film["models"].items()}
    return film


def model(shape, box, material="glaze"):
    return {"joints": [{"name": shape, "segment": {"shape": shape, "sbb": box, "material": material}}]}


def ball_and_poles(side, size):
    """They stand on a floor in the light of a sun that takes up `size` degrees in the sky."""
    def glaze(color):
        return {"color": color, "reflection": "cook-torrance", "ambient": 0.35, "diffuse": 0.75, "roughness": 0.3}
    return {"frames": 1, "size": [side, side], "ambient": {"sky": [0.76, 0.86, 1], "ground": [0.62, 0.57, 0.5]},
            "camera": {"eye": [0.8, -8, 5.2], "at": [0.6, 0.4, 0.75], "fov": 32},
            "lights": [{"direction": [-0.8, -0.3, 0.66], "color": [1, 0.95, 0.86], "intensity": 1.6, "shadow": True,
                        "size": size},
                       {"direction": [0.5, -0.8, 0.4], "color": [0.75, 0.85, 1], "intensity": 0.3}],
            "materials": {"floor": {"color": [0.74, 0.72, 0.68], "ambient": 0.35, "diffuse": 0.8, "specular": 0},
                          "rose": glaze([0.86, 0.4, 0.5]), "sand": glaze([0.9, 0.78, 0.52])},
            "models": {"floor": model("box", [[-40, -40, -0.2], [40, 60, 0]], "floor"),
                       "ball": model("sphere", [[-0.8, -0.8, 0], [0.8, 0.8, 1.6]], "rose"),
                       "pole": model("cylinder", [[-0.1, -0.1, 0], [0.1, 0.1, 2.4]], "sand")},
            "actors": [{"name": "floor", "model": "floor"}, {"name": "ball", "model": "ball", "place": [-0.75, -0.9, 0]},
                       *[{"name": f"pole-{k}", "model": "pole", "place": [-1.3 + 1.1 * k, 0.9, 0]} for k in range(3)]]}


def still_life(side, material):
    """A teapot and a sphere in the default light, diced coarsely, so that interpolations differ."""
    return {"frames": 1, "size": [side, side], "background": [0.32, 0.34, 0.38], "dice": 5,
            "camera": {"eye": [0.3, -13, 5], "at": [0.3, 0, 1], "fov": 30},
            "materials": {"glaze": {"color": [0.75, 0.33, 0.18], **material}},
            "models": {"pot": model("teapot", [[-3, -2, 0], [3.525, 2, 3.15]]),
                       "ball": model("sphere", [[-1, -1, -1], [1, 1, 1]])},
            "actors": [{"name": "pot", "model": "pot", "place": [0.2, 1, 0.2]},
                       {"name": "ball", "model": "ball", "place": [-1.4, -2.5, 0]}]}


def main():
    build, out = sys.argv[1:]
    os.makedirs(out, exist_ok=True)
    with tempfile.TemporaryDirectory() as folder:
        gallery = Gallery(build, out, folder)
        gallery.details()
        gallery.models()
        gallery.colors()
        gallery.walk()
        gallery.suns()


if __name__ == "__main__":
    try:
        main()
    except quality.Trouble as trouble:
        sys.exit(f"gallery.py: {trouble}")
