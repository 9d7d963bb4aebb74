"""Random edits of a film: words after `mars`, in which FILM stands for the film's file. Who adds a command that changes
films adds it here: `mars bench identity` then compares the pixels of edited films over all ways to render. An edit
follows from the choices of a random.Random and from the film as it is. MARS may refuse an edit, for example of a part
that cannot turn; then the film must stay as it was."""

EASES = ["linear", "in", "out", "both", "spline", "hold", "0.3,-0.2,0.6,1.2"]


def random_edit(choose, film):
    """The words of one edit. `film`: the film's JSON."""
    kinds = list(Edits.KINDS)
    choose.shuffle(kinds)
    for kind in kinds:
        if words := kind(Edits(choose, film)):
            return words
    raise AssertionError("an edit of the film's settings is always possible")


class Edits:
    """Each kind of edit gives its words, or none if the film has nothing that it could change."""

    def __init__(self, choose, film):
        self.choose = choose
        self.film = film
        self.keyed = {**{actor["name"]: actor["keys"] for actor in film["actors"] if "keys" in actor},
                      **{f"light/{i}": light["keys"] for i, light in enumerate(film.get("lights", []), 1) if "keys" in light},
                      **{f"material/{name}": material["keys"] for name, material in film["materials"].items()
                         if "keys" in material}}
        if "keys" in film["camera"]:
            self.keyed["camera"] = film["camera"]["keys"]

    def number(self, least, most):
        return f"{self.choose.uniform(least, most):.3f}"

    def numbers(self, least, most, count=3):
        return ",".join(self.number(least, most) for _ in range(count))

    def frame(self):
        return str(self.choose.randrange(self.film["frames"]))

    def actor(self):
        return self.choose.choice(self.film["actors"])["name"]

    def free_name(self):
        names = {actor["name"] for actor in self.film["actors"]}
        return next(name for name in (f"new{i}" for i in range(1000)) if name not in names)

    def thing_with_keys(self):
        """Its name, and the frame of one of its keys."""
        if not self.keyed:
            return None, None
        thing = self.choose.choice(sorted(self.keyed))
        return thing, str(self.choose.choice(self.keyed[thing])["frame"])

    # Settings of the film.

    def setting(self):
        return ["film", "FILM", "set", self.choose.choice([
            f"frames={self.film['frames'] + self.choose.choice([1, 2])}", f"samples={self.choose.choice([1, 2, 4])}",
            f"background={self.numbers(0, 1)}", f"ambient={self.numbers(0, 1)}", f"dice={self.choose.choice([1, 3, 8])}",
            f"intervals={self.choose.choice(['auto', 'keyframes'])}",
            f"size={self.size()}"])]

    def size(self):
        """A panorama is twice as wide as high."""
        width, height = (self.choose.randint(9, 160) for _ in "wh")
        return f"{2 * height if self.film['camera'].get('projection') == 'panorama' else width},{height}"

    # Actors, lights and materials.

    def add_actor(self):
        model = self.choose.choice(["ball", "box", *self.film["models"]])
        where = self.choose.choice([["--beside", self.frame()], ["--place", *(self.number(-1.4, 1.4) for _ in range(3))]])
        return ["film", "FILM", "add", self.free_name(), "--model", model, *where, "--turn", self.number(-180, 180)]

    def remove_actor(self):
        return ["film", "FILM", "remove", self.actor()] if len(self.film["actors"]) > 2 else None

    def rename_actor(self):
        return ["film", "FILM", "rename", self.actor(), self.free_name()]

    def add_light(self):
        kind = self.choose.choice([[f"direction={self.numbers(-1, 1)}"], [f"place={self.numbers(-3, 3)}", "reach=4"],
                                   [f"place={self.numbers(1, 4)}", f"at={self.numbers(-1, 1)}", "cone=20,45"]])
        return ["film", "FILM", "light", "add", *kind, f"intensity={self.number(0.5, 3)}"]

    def set_light(self):
        lights = len(self.film.get("lights", []))
        return ["film", "FILM", "light", "set", str(self.choose.randint(1, lights)), f"intensity={self.number(0.5, 3)}",
                f"color={self.numbers(0.2, 1)}",
                *self.choose.choice([[], ["shadow=true"], ["shadow=false", "size=0.5"]])] if lights else None

    def remove_light(self):
        lights = len(self.film.get("lights", []))
        return ["film", "FILM", "light", "remove", str(self.choose.randint(1, lights))] if lights else None

    def light_rig(self):
        return ["film", "FILM", "light", "rig"] if "lights" not in self.film else None

    def add_material(self):
        return ["film", "FILM", "material", "add", f"worn{len(self.film['materials'])}", "--actor", self.actor(),
                f"color={self.numbers(0.1, 1)}", f"reflection={self.choose.choice(['phong', 'blinn-phong'])}"]

    def set_material(self):
        return ["film", "FILM", "material", "set", self.choose.choice(sorted(self.film["materials"])),
                self.choose.choice([f"ambient={self.number(0, 1)}", "interpolation=gouraud", "interpolation=flat", "sides=2", "casts=false",
                                    "receives=false"])]

    # Poses and keys.

    def pose_actor(self):
        actor = self.choose.choice(self.film["actors"])
        model = self.film["models"][actor["model"]]
        joints = [joint["name"] for joint in model.get("joints", [])] if isinstance(model, dict) else []
        place = self.choose.choice([f"place={self.numbers(-1.4, 1.4)}", f"place.x+={self.number(-1, 1)}"])
        parts = [place, f"turn={self.numbers(-180, 180)}", *(f"/{joint}={self.numbers(-120, 120)}" for joint in joints)]
        return ["animate", "FILM", "pose", actor["name"], *self.choose.sample(parts, self.choose.randint(1, 2)), "--frame",
                self.frame(), "--clamp", *self.choose.choice([["--ease", self.choose.choice(EASES)], ["--falloff", "3"]])]

    def cut(self):
        thing = self.choose.choice(["camera", self.actor()])
        return ["animate", "FILM", "cut", thing, "--frame", self.frame()]

    def pose_camera(self):
        part = self.choose.choice([f"eye={self.number(-3, 3)},{self.number(-6, -3)},{self.number(-1, 3)}",
                                   f"at={self.numbers(-0.5, 0.5)}", f"fov={self.number(25, 70)}",
                                   f"height={self.number(1, 8)}", f"shift={self.number(-0.5, 0.5)},{self.number(-0.5, 0.5)}"])
        return ["animate", "FILM", "pose", "camera", part, "--frame", self.frame()]

    def pose_light(self):
        lights = len(self.film.get("lights", []))
        return ["animate", "FILM", "pose", f"light/{self.choose.randint(1, lights)}", f"intensity={self.number(0.2, 3)}",
                "--frame", self.frame()] if lights else None

    def pose_material(self):
        return ["animate", "FILM", "pose", f"material/{self.choose.choice(sorted(self.film['materials']))}",
                f"color={self.numbers(0.1, 1)}", "--frame", self.frame()]

    def key(self):
        return ["animate", "FILM", "key", self.actor(), "--frame", self.frame(), "--ease", self.choose.choice(EASES)]

    def displace(self):
        thing, frame = self.thing_with_keys()
        return ["animate", "FILM", self.choose.choice(["move", "copy"]), thing, "--frame", frame, "--to", self.frame()] \
            if thing else None

    def delete(self):
        thing, frame = self.thing_with_keys()
        return ["animate", "FILM", "delete", thing, "--frame", frame] if thing else None

    def time(self):
        thing, frame = self.thing_with_keys()
        change = self.choose.choice([["--ease", self.choose.choice(EASES)], ["--hold", "2"], ["--shift", "1"],
                                     ["--anticipate", "15", "--overshoot", "10"]])
        return ["animate", "FILM", "time", thing, "--frame", frame, *change] if thing else None

    def stretch(self):
        thing, frame = self.thing_with_keys()
        return ["animate", "FILM", "time", thing, "--frame", f"{frame}-", "--stretch", "1.5"] if thing else None

    def tangent(self):
        actors = [name for name, keys in self.keyed.items() if any("place" in key for key in keys)]
        if not actors:
            return None
        actor = self.choose.choice(sorted(actors))
        frame = self.choose.choice([key["frame"] for key in self.keyed[actor] if "place" in key])
        return ["animate", "FILM", "tangent", actor, "place", "--frame", str(frame),
                *self.choose.choice([["--flat"], ["--auto"], ["--out", self.numbers(-0.5, 0.5)]])]

    def reduce(self):
        actors = sorted(actor["name"] for actor in self.film["actors"] if "keys" in actor)
        return ["animate", "FILM", "reduce", self.choose.choice(actors), "--error", "2"] if actors else None

    # What carries actors, and what the camera follows.

    def attach(self):
        names = [actor["name"] for actor in self.film["actors"]]
        if len(names) < 2:
            return None
        carried, carrier = self.choose.sample(names, 2)
        return ["animate", "FILM", "attach", carried, "--to", carrier, "--frame", self.frame()]

    def detach(self):
        carried = [actor["name"] for actor in self.film["actors"]
                   if "attach" in actor or any("attach" in key for key in actor.get("keys", []))]
        return ["animate", "FILM", "detach", self.choose.choice(carried), "--frame", self.frame()] if carried else None

    def camera_goes_along(self):
        looks = any(isinstance(key.get("at"), dict) for key in self.film["camera"].get("keys", []))
        change = self.choose.choice([["look", self.actor()], ["follow", self.actor()], *([["look", "--end"]] if looks else [])])
        return ["animate", "FILM", *change, "--frame", self.frame()]

    KINDS = [setting, add_actor, remove_actor, rename_actor, add_light, set_light, remove_light, light_rig, add_material,
             set_material, pose_actor, pose_actor, pose_camera, pose_light, pose_material, key, cut, displace, delete, time,
             stretch, tangent, reduce, attach, detach, camera_goes_along]
