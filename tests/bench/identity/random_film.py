"""Random films that have something of everything a film can have. Who adds a feature adds it here: `mars bench identity`
then compares its pixels over all ways to render. A film follows from its seed alone."""
import math
import random

from random_limb import limb

SHAPES = {"box": {}, "sphere": {}, "ellipsoid": {}, "cylinder": {}, "disc": {"rim": (0.01, 0.4)}, "cone": {"top": (0, 1)},
          "capsule": {"ends": (0.05, 0.5)}, "rounded_box": {"edge": (0.01, 0.5)}, "torus": {"tube": (0.05, 0.24)},
          "teapot": {"lid": (0.8, 1.2)}}
REFLECTIONS = ["phong", "blinn-phong", "cook-torrance", "metallic-roughness"]
INTERPOLATIONS = ["phong", "phong", "gouraud", "flat"]
EASES = ["linear", "in", "out", "both", "spline", [0.3, -0.2, 0.6, 1.2]]
FIGURES = ["man", "child", "dog"]
REACH = 1.4   # of what actors do, from the origin
LONGEST = 12  # frames


class RandomFilm:
    """`json`: the film. `commands`: words after `mars`, in which FILM stands for its file, that go on with it."""

    def __init__(self, seed, largest=160, longest=LONGEST):
        self.random = random.Random(seed)
        self.frames = self.random.randint(2, longest)
        self.version = 1
        self.commands = []
        coded = self.chance(0.3)
        self.json = {"frames": self.frames, "rate": 24, "size": [self.random.randint(9, largest) for _ in "wh"],
                     "samples": self.random.choice([1, 1, 2, 4, 4, 8, 16]), "background": self.color(),
                     "color": "coded" if coded else "linear", "camera": self.camera(coded)}
        if self.chance(0.3):
            self.json["dice"] = self.random.choice([1, 2, 5, 16])
        if self.chance(0.4):
            self.json["ambient"] = self.random.choice([self.color(), {"sky": self.color(), "ground": self.color()}])
        if self.chance(0.3):
            self.json["fog"] = {"start": self.number(0, 6), "end": self.number(8, 60)}
        if self.chance(0.8):
            self.json["lights"] = [self.light() for _ in range(self.random.randint(0, 4))]
        self.json["materials"] = {f"m{i}": self.material(True) for i in range(self.random.randint(1, 3))}
        self.json["models"] = {f"model{i}": self.model() for i in range(self.random.randint(1, 3))}
        self.json["actors"] = [self.actor(f"actor{i}") for i in range(self.random.randint(1, 5))]
        self.attach()
        self.follow()
        if self.version > 1:
            self.json = {"version": self.version, **self.json}
        self.add_figure()
        self.add_settings()
        self.add_slopes()
        self.see_otherwise(random.Random(f"camera of {seed}"))
        self.add_limb(random.Random(f"limb of {seed}"))

    def chance(self, part):
        return self.random.random() < part

    def number(self, least, most, digits=3):
        return round(self.random.uniform(least, most), digits)

    def color(self, least=0.0):
        return [self.number(least, 1) for _ in range(3)]

    def place(self, reach=REACH):
        return [self.number(-reach, reach) for _ in range(3)]

    def turn(self):
        return [self.number(-180, 180) for _ in range(3)]

    def direction(self):
        while True:
            vector = self.place(1)
            if math.hypot(*vector) > 0.1:
                return vector

    # Some frames, of which the last may lie behind the film's; each part is in some of its keys.
    def keys(self, parts, at_frame_0=()):
        frames = sorted(self.random.sample(range(self.frames + 3), self.random.randint(1, min(4, self.frames))))
        keys = []
        for frame in frames:
            key = {"frame": frame, **{name: make() for name, make in parts.items() if self.chance(0.7)}}
            if self.chance(0.5):
                key["ease"] = self.random.choice(EASES)
                self.version = max(self.version, 2 if key["ease"] == "spline" else 1)
            keys.append(key)
        for name in at_frame_0:
            keys[0][name] = parts[name]()
        return keys

    def camera(self, coded):
        eye = [self.number(-3, 3), self.number(-6, -2.5), self.number(-1, 3)]
        camera = {"eye": eye, "at": self.place(0.5), "fov": self.number(25, 70)}
        if not coded and self.chance(0.4):
            camera["exposure"] = self.number(-1, 1)
        if self.chance(0.3):  # a moving camera: every frame is drawn from nothing
            camera["keys"] = self.keys({"fov": lambda: self.number(20, 90)})
            if any("fov" in key for key in camera["keys"]):
                del camera["fov"]
        self.project(camera)
        return camera

    def project(self, camera):
        if self.chance(0.25):
            camera["projection"] = "orthographic"
            camera["height"] = self.number(1, 8)
            if "keys" in camera and self.chance(0.5):
                del camera["height"]
                camera["keys"][0]["height"] = self.number(1, 8)
        if self.chance(0.25):
            camera["shift"] = [self.number(-0.6, 0.6), self.number(-0.6, 0.6)]

    def light(self):
        kind = self.random.choice(["far", "far", "point", "spot"])
        light = {"color": self.color(0.4), "intensity": self.number(0.8, 3)}
        if kind == "far":
            light["direction"] = [*self.direction()[:2], 0.5]
        else:
            light.update(place=[*self.place(3)[:2], self.number(1, 4)], reach=self.number(2, 9))
        if kind == "spot":
            inner = self.number(5, 60)
            light.update(at=self.place(1), cone=[inner, inner + self.number(1, 60)])
        widths = (0.1, 30) if kind == "far" else (0.05, 2)
        if self.chance(0.6):
            light["shadow"] = True
            if self.chance(0.5):
                light["size"] = self.number(*widths)
        if self.chance(0.2):
            light["keys"] = self.keys({"intensity": lambda: self.number(0.5, 3), "size": lambda: self.number(*widths)})
            for name in {name for key in light["keys"] for name in key} & {"intensity", "size"}:
                light.pop(name, None)
        return light

    def material(self, of_film):
        reflection = self.random.choice(REFLECTIONS)
        material = {"color": self.color(0.2), "reflection": reflection, "interpolation": self.random.choice(INTERPOLATIONS),
                    "sides": self.random.choice([1, 2, 2])}
        if reflection == "metallic-roughness":
            material.update(roughness=self.number(0.05, 1), metallic=self.number(0, 1))
        else:
            material.update(diffuse=self.number(0.4, 1), specular=self.number(0, 1))
        material.update({name: False for name in ("casts", "receives") if self.chance(0.2)})
        if of_film and self.chance(0.3):
            material["keys"] = self.keys({"color": self.color})
            if any("color" in key for key in material["keys"]):
                del material["color"]
        return material

    def shape(self, own):
        name = self.random.choice([*SHAPES, *own])
        options = {key: self.number(*limits) for key, limits in SHAPES.get(name, {}).items() if self.chance(0.5)}
        return {"shape": name, **options}

    def box(self):
        low = [self.number(-0.8, 0) for _ in range(3)]
        return [low, [round(at + self.number(0.3, 1.6), 3) for at in low]]

    def limits(self):
        return {axis: sorted([self.number(-120, 20), self.number(20, 120)]) for axis in "xyz" if self.chance(0.6)}

    def model(self):
        own = self.own_shapes()
        materials = {f"own{i}": self.material(False) for i in range(self.random.randint(0, 2))}
        joints = []
        for i in range(self.random.randint(1, 5)):
            joint = {"name": f"j{i}", "place": self.place(0.8), "limits": self.limits()}
            if i > 0:
                joint["parent"] = f"j{self.random.randrange(i)}"
            if self.chance(0.2):
                joint["x_axis"] = [1, self.number(-0.5, 0.5), 0]
            if i == 0 or self.chance(0.8):
                joint["segment"] = {**self.shape(own), "sbb": self.box(),
                                    "material": self.random.choice([*materials, *self.json["materials"]])}
            joints.append(joint)
        return {"materials": materials, "shapes": own, "joints": joints}

    # Meshes and B-splines.
    def own_shapes(self):
        shapes = {}
        if self.chance(0.4):
            shapes["stone"] = {"mesh": {"vertices": [[self.number(0, 1) for _ in range(3)] for _ in range(4)],
                                        "faces": [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]}}
        if self.chance(0.4):
            size = self.random.randint(4, 6)
            points = [[[round(u / (size - 1), 3), round(v / (size - 1), 3), self.number(0, 1)] for u in range(size)]
                      for v in range(size)]
            shapes["sail"] = {"bspline": {"points": points, "u": {"degree": 3}, "v": {"degree": self.random.randint(1, 3)}}}
        return shapes

    def pose(self, model):
        """Within the limits of its joints."""
        pose = {}
        for joint in model["joints"]:
            limits = joint["limits"]
            if limits and self.chance(0.6):
                pose[joint["name"]] = [self.number(*limits[axis]) if axis in limits else 0 for axis in "xyz"]
        return pose

    def actor(self, name):
        of = self.random.choice(list(self.json["models"]))
        model = self.json["models"][of]
        actor = {"name": name, "model": of}
        if self.chance(0.2):
            actor["material"] = self.random.choice(list(self.json["materials"]))
        if self.chance(0.6):
            actor["keys"] = self.keys({"place": self.place, "turn": self.turn, "pose": lambda: self.pose(model)}, ["place"])
        else:
            actor.update(place=self.place(), turn=self.turn(), pose=self.pose(model))
        return actor

    # The last actor is carried by the first from some frame on.
    def attach(self):
        actors = self.json["actors"]
        if len(actors) < 2 or not self.chance(0.4):
            return
        self.version = 2
        held = {"actor": actors[0]["name"], "joint": "j0", "place": self.place(1)}
        if "keys" in actors[-1]:
            actors[-1]["keys"][-1]["attach"] = held
        else:
            actors[-1]["attach"] = held

    # The camera looks at an actor wherever it goes.
    def follow(self):
        if self.chance(0.15):
            self.version = 2
            self.json["camera"]["at"] = {"actor": self.json["actors"][0]["name"]}

    def add_settings(self):
        if self.json["color"] == "linear" and self.chance(0.2):
            self.json["curve"] = "none" if self.chance(0.5) else "agx"
        if self.chance(0.2):
            self.json["intervals"] = "keyframes"
        if self.chance(0.2):
            self.json["camera"]["up"] = [self.number(-0.5, 0.5), 0, 1]

    # Keys of places that have slopes of their own.
    def add_slopes(self):
        for actor in self.json["actors"]:
            for key in actor.get("keys", []):
                if "place" in key and self.chance(0.2):
                    key["place"] = {"value": key["place"], "ease": "spline", "out": self.place(0.3), "in": self.place(0.3)}
                    self.json["version"] = 2

    # Panoramas, pixels that are not square, eyes of stereo pairs. They have choices of their own: films of a seed stay.
    def see_otherwise(self, choose):
        camera = self.json["camera"]
        kind = choose.choice(["panorama", "eyes", "pixels", "pixels", "", "", "", ""])
        if kind == "panorama" and "projection" not in camera:
            camera["projection"] = "panorama"
            height = choose.randint(2, 16)
            self.json["size"] = [2 * height, height]
        if kind == "eyes" and "projection" not in camera:
            width, height = self.json["size"]
            convergence = round(choose.uniform(1, 8), 3)
            apart = choose.uniform(0.002, 0.05) * convergence * width / height  # shifts that every field of view allows
            camera.update(interaxial=round(apart, 4), convergence=convergence)
        if kind == "pixels":
            self.json["pixel_aspect"] = choose.choice([0.5, 1.25, 2, round(choose.uniform(0.1, 8), 3)])

    # What bends. It has choices of its own: films of a seed stay.
    def add_limb(self, choose):
        if choose.random() < 0.5:
            return
        self.json["models"]["limb"], joints = limb(choose)
        turn = lambda: [round(choose.uniform(-70, 70), 1) for _ in range(3)]
        frames = sorted(choose.sample(range(self.frames + 2), min(3, self.frames)))
        keys = [{"frame": frame, "pose": {joint: turn() for joint in choose.sample(joints, 2)}} for frame in frames]
        keys[0]["place"] = [round(choose.uniform(-1, 1), 2) for _ in range(3)]
        self.json["actors"].append({"name": "limb", "model": "limb", "keys": keys})

    # A figure of the library that does something, and a few edits.
    def add_figure(self):
        if not self.chance(0.35):
            return
        figure = self.random.choice(FIGURES)
        self.commands.append(["film", "FILM", "add", "figure", "--model", figure, "--height", "3"])
        motion = {"dog": ["walk", "--to", "2", "1"]}.get(figure, self.random.choice([["walk", "--to", "2", "1"], ["wave"]]))
        self.commands.append(["animate", "FILM", motion[0], "figure", *motion[1:]])
        if self.chance(0.5):
            self.commands.append(["animate", "FILM", "reduce", "figure", "--error", "1"])
