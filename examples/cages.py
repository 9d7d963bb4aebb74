"""Cages of quads, whose points follow bones: surfaces that bend, for human.py and animals.py.

A cage is a Catmull-Clark control net. Its points are made where the surface shall be; `fit` moves them outward so that
the surface comes there. Faces are counter-clockwise as seen from outside.
"""
import math


def smooth(x):
    """0 to 1 while x goes from 0 to 1, with no slope at either end."""
    x = max(0.0, min(1.0, x))
    return x * x * (3 - 2 * x)


def mixed(*parts):
    """Weights of bones, of parts (weights, share)."""
    sums = {}
    for weights, share in parts:
        for bone, weight in weights.items():
            sums[bone] = sums.get(bone, 0) + share * weight
    return {bone: weight for bone, weight in sums.items() if weight > 1e-6}


def along(chain, at):
    """Weights at a place along a limb. `chain`: bones in order, after the first each with where it begins and ends to
    take over: (bone, from, to)."""
    weights = {chain[0]: 1.0}
    for bone, start, end in chain[1:]:
        share = smooth((at - start) / (end - start))
        weights = mixed((weights, 1 - share), ({bone: 1.0}, share))
    return weights


def squared(value, by):
    """Pulls a sine or cosine towards +-1."""
    def pull(v):
        return 1.5 * v - 0.5 * v ** 3
    return value + by * (pull(pull(value)) - value)


def outline(angles, front, back, width, square=0.0, square_back=0.0):
    """Points (forward, aside) of a closed curve, from its front towards its left."""
    points = []
    for angle in angles:
        c, s = math.cos(math.radians(angle)), math.sin(math.radians(angle))
        by = square if c > 0 else square_back
        forward, aside = squared(c, by), squared(s, by)
        points.append((forward * (front if forward > 0 else back), aside * width))
    return points


class Cage:
    def __init__(self):
        self.points, self.weights, self.faces = [], [], []

    def add(self, point, weights):
        self.points.append(tuple(point))
        self.weights.append(weights)
        return len(self.points) - 1

    def ring(self, points, weights):
        """Points with the same weights, or weights of a function of the point."""
        return [self.add(point, weights(point) if callable(weights) else weights) for point in points]

    def face(self, *corners):
        self.faces.append(corners)

    def bridge(self, low, high):
        """Between rings that run counter-clockwise as seen from `high`. None: no point; faces there are a hole."""
        for i, j in zip(range(len(low)), [*range(1, len(low)), 0]):
            corners = (low[i], low[j], high[j], high[i])
            if None not in corners:
                self.face(*corners)

    def tube(self, rings):
        for low, high in zip(rings, rings[1:]):
            self.bridge(low, high)

    def cap(self, ring, middle=None):
        """Closes a ring, which runs counter-clockwise as seen from outside: four points as they are, else about a point
        in the middle."""
        if len(ring) == 4:
            return self.face(*ring)
        at = [sum(self.points[i][axis] for i in ring) / len(ring) for axis in range(3)]
        centre = self.add(middle or at, self.weights[ring[0]])
        for i in range(0, len(ring), 2):
            self.face(centre, ring[i], ring[i + 1], ring[(i + 2) % len(ring)])

    def fit(self, rounds=4, loose=()):
        """Moves the points so that the surface comes near where they were; `loose` ones stay, which rounds it."""
        targets = self.points
        stencils = [[(i, 1.0)] if i in loose else stencil for i, stencil in enumerate(self.limit_stencils())]
        for _ in range(rounds):
            reached = [tuple(sum(w * self.points[i][axis] for i, w in stencil) for axis in range(3))
                       for stencil in stencils]
            self.points = [tuple(p + t - r for p, t, r in zip(point, target, place))
                           for point, target, place in zip(self.points, targets, reached)]
        return self

    def limit_stencils(self):
        """For each point the points and weights whose mean is the surface's place there."""
        edges, across, sides = {}, {}, {}
        for face in self.faces:
            for k, a in enumerate(face):
                b, c, d = (face[(k + step) % 4] for step in (1, 2, 3))
                edges.setdefault(a, set()).update((b, d))
                across.setdefault(a, []).append(c)
                for pair in (a, b), (b, a):
                    sides[pair] = sides.get(pair, 0) + 1
        stencils = []
        for a in range(len(self.points)):
            if a not in edges:
                stencils.append([(a, 1.0)])
                continue
            rim = [b for b in edges[a] if sides[a, b] == 1]
            if rim:
                stencils.append([(a, 2 / 3)] + [(b, 1 / 6) for b in rim])
                continue
            n = len(edges[a])
            part = 1 / (n * (n + 5))
            stencils.append([(a, n * n * part), *((b, 4 * part) for b in edges[a]), *((c, part) for c in across[a])])
        return stencils

    def mirrored(self):
        """The other side's."""
        other = Cage()
        other.points = [(x, -y, z) for x, y, z in self.points]
        other.weights = [{swapped(bone): w for bone, w in weights.items()} for weights in self.weights]
        other.faces = [tuple(reversed(face)) for face in self.faces]
        return other

    def box(self):
        return [[pick(p[axis] for p in self.points) for axis in range(3)] for pick in (min, max)]

    def shape(self, bones, level=1):
        """For a model's `shapes`; `bones`: the skin's joints."""
        low, high = self.box()
        sizes = [b - a or 1 for a, b in zip(low, high)]
        rows = []
        for weights in self.weights:
            heaviest = sorted(weights.items(), key=lambda item: -item[1])[:4]
            rows.append([number for bone, weight in sorted(heaviest, key=lambda item: bones.index(item[0]))
                         for number in (bones.index(bone), round(weight, 3))])
        points = [[round((v - a) / size, 4) + 0.0 for v, a, size in zip(point, low, sizes)] for point in self.points]
        return {"subdivision": {"points": points, "faces": [list(face) for face in self.faces], "level": level,
                                "bones": rows}}

    def bones(self, order):
        """Those that its points follow, in the model's order."""
        used = {bone for weights in self.weights for bone in weights}
        return [bone for bone in order if bone in used]


def swapped(bone):
    for side, other in ("left-", "right-"), ("right-", "left-"):
        if bone.startswith(side):
            return other + bone[len(side):]
    return bone


# ---- Models.

def scaled(vector, unit):
    return [round(x * unit, 4) + 0.0 for x in vector]


def clothe(joints, carrier, shape, cage, material, unit, level=1):
    """Gives the joint `carrier` the cage, whose places are from the ground, as a segment. Returns the shape."""
    at = rest_places(joints)[carrier]
    bones = cage.bones([each["name"] for each in joints])
    sbb = [scaled(end, unit) for end in cage.box()]
    next(each for each in joints if each["name"] == carrier)["segment"] = {
        "shape": shape, "sbb": [[round(v - a, 4) for v, a in zip(end, at)] for end in sbb], "material": material,
        "skin": {"joints": bones, "blend": "dual-quaternions"}}
    return cage.shape(bones, level)


def rest_places(joints):
    places = {}
    for each in joints:
        above = places.get(each.get("parent"), (0, 0, 0))
        places[each["name"]] = tuple(a + b for a, b in zip(above, each["place"]))
    return places
