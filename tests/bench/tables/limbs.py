"""A limb in the unit cube, z up, as a closed mesh of a wanted number of triangles and as Bezier patches.

Both follow one profile: thick at the joint (z = 1), thin at the other end, with round ends."""
import functools
import math

ROUNDNESS = 0.7  # exponent of a superellipse: 1 is an ellipsoid, 0 a cylinder
TAPER = 0.35     # how much thinner the lower end is
CIRCLE = 4 * (math.sqrt(2) - 1) / 3  # a quarter circle as a cubic curve
PATCH_ROWS = 6   # of 4 patches each, between the patches of the two ends
PATCHES = 4 * PATCH_ROWS + 2
END = 0.06       # part of the profile that an end's patch covers


def profile(t):
    """Radius and height at t, from 0 at the lower end to 1 at the joint."""
    cosine, sine = math.cos(math.pi * t), math.sin(math.pi * t)
    height = 0.5 - 0.5 * math.copysign(abs(cosine) ** ROUNDNESS, cosine)
    return 0.5 * abs(sine) ** ROUNDNESS * (1 - TAPER * (1 - height)), height


def rounded(point):
    return [round(x, 6) for x in point]


def ring_point(t, turn):
    radius, height = profile(t)
    angle = 2 * math.pi * turn
    return [0.5 + radius * math.cos(angle), 0.5 + radius * math.sin(angle), height]


def ring_sizes(triangles, slender):
    """Sides of each ring. A closed mesh of rings between two poles has two triangles for each side of a ring."""
    assert triangles >= 8 and triangles % 2 == 0, f"{triangles} triangles do not close a limb"
    sides = triangles // 2
    rings = max(1, min(sides // 3, round(math.sqrt(sides * slender))))
    return [sides * (k + 1) // rings - sides * k // rings for k in range(rings)]


def stitched(lower, upper):
    """Triangles between two rings of vertex numbers, each once around: the shorter step first."""
    faces, i, j = [], 0, 0
    while i < len(lower) or j < len(upper):
        if j == len(upper) or (i < len(lower) and (i + 1) * len(upper) <= (j + 1) * len(lower)):
            faces.append([lower[i], lower[(i + 1) % len(lower)], upper[j % len(upper)]])
            i += 1
        else:
            faces.append([lower[i % len(lower)], upper[(j + 1) % len(upper)], upper[j]])
            j += 1
    return faces


@functools.lru_cache
def mesh(triangles, slender=1.0):
    """A limb of exactly `triangles` triangles. `slender`: rings to sides of a ring."""
    sizes = ring_sizes(triangles, slender)
    vertices, rings = [ring_point(0, 0)], []
    for k, size in enumerate(sizes):
        rings.append(range(len(vertices), len(vertices) + size))
        vertices += [ring_point((k + 1) / (len(sizes) + 1), side / size) for side in range(size)]
    vertices.append(ring_point(1, 0))
    faces = [[0, after, vertex] for vertex, after in around(rings[0])]
    for lower, upper in zip(rings, rings[1:]):
        faces += stitched(lower, upper)
    faces += [[vertex, after, len(vertices) - 1] for vertex, after in around(rings[-1])]
    assert len(faces) == triangles
    return {"mesh": {"vertices": [rounded(v) for v in vertices], "faces": faces, "crease": 180}}


def around(ring):
    return [(ring[k], ring[(k + 1) % len(ring)]) for k in range(len(ring))]


def quarter(radius, height, number):
    """Control points of a quarter of a circle about the limb's axis."""
    points = []
    for along, beside in ((1, 0), (1, CIRCLE), (CIRCLE, 1), (0, 1)):
        for _ in range(number):
            along, beside = -beside, along
        points.append([0.5 + radius * along, 0.5 + radius * beside, height])
    return points


def span(t, step):
    """Radius and height of the four control points of the profile from t to t + step."""
    def slope(at):
        return [(b - a) * step / 0.02 for a, b in zip(profile(at - 0.01), profile(at + 0.01))]
    begin, end = profile(t), profile(t + step)
    return [begin, [p + s / 3 for p, s in zip(begin, slope(t))], [p - s / 3 for p, s in zip(end, slope(t + step))], end]


def end_patch(t):
    """A patch over the ring at t, raised towards the profile's end."""
    radius, height = profile(t)
    pole = 0.0 if t < 0.5 else 1.0
    sides = [quarter(radius, height, number) for number in range(4)]
    rows = [sides[0], [sides[3][2], None, None, sides[1][1]], [sides[3][1], None, None, sides[1][2]], sides[2][::-1]]
    inner = radius * (math.sqrt(2) - 1)
    for v, u in ((1, 1), (1, 2), (2, 1), (2, 2)):
        towards = rows[3 * (v - 1)][3 * (u - 1)]
        rows[v][u] = [0.5 + (x - 0.5) * inner / radius for x in towards[:2]] + [pole]
    if pole == 1.0:
        return [point for row in rows for point in row]
    return [point for row in rows for point in row[::-1]]


def patches():
    """The limb as PATCHES bicubic patches: rows of four around, and one at each end."""
    step = (1 - 2 * END) / PATCH_ROWS
    sides = [[point for radius, height in span(END + row * step, step) for point in quarter(radius, height, number)]
             for row in range(PATCH_ROWS) for number in range(4)]
    return [[rounded(point) for point in patch] for patch in sides + [end_patch(END), end_patch(1 - END)]]
