"""POV-Ray and Tachyon: a mesh (mesh.h) as their scene files, rendered once. They neither cull nor keep a scene loaded;
what counts is the time they tell for tracing."""
import array
import os
import re
import shutil
import struct
import subprocess

from competitor import Trouble

HEAD = struct.Struct("<8s2If2ff3f3f3f3fI5I")
PATCH_WORDS = 7


class Scene:
    def __init__(self, path):
        with open(path, "rb") as file:
            fields = HEAD.unpack(file.read(HEAD.size))
            numbers = iter(fields[1:])

            def take(count):
                return [next(numbers) for _ in range(count)]

            (self.width, self.height), (self.scale,) = take(2), take(1)
            take(3)  # centre and near
            self.background, self.to_light, self.light = take(3), take(3), take(3)
            (self.ambient, self.diffuse, self.specular), (squarings,) = take(3), take(1)
            self.exponent = 2 ** squarings
            looks, patches, vertices, triangles, _ = take(5)
            self.looks = self.rows(file, "f", looks, 3)
            self.patches = self.rows(file, "I", patches, PATCH_WORDS)
            self.vertices = self.rows(file, "f", vertices, 6)
            self.triangles = self.rows(file, "I", triangles, 3)

    @staticmethod
    def rows(file, kind, count, width):
        numbers = array.array(kind)
        numbers.fromfile(file, count * width)
        return list(zip(*[iter(numbers)] * width))


def words(numbers, between=" "):
    return between.join(f"{n:.7g}" for n in numbers)


def vector(numbers):
    return f"<{words(numbers, ',')}>"


def write_pov(scene, path):
    with open(path, "w") as file:
        print(f"""#version 3.7;
global_settings {{ assumed_gamma 1 ambient_light 1 }}
background {{ rgb {vector(scene.background)} }}
camera {{ location 0 direction <0,0,{-scene.scale / scene.height}> up y right {scene.width / scene.height}*x }}
light_source {{ {vector(1e6 * c for c in scene.to_light)} rgb {vector(scene.light)} parallel point_at 0 }}
#default {{ finish {{ ambient {scene.ambient} diffuse {scene.diffuse} phong {scene.specular} phong_size {scene.exponent} }} }}
""", file=file)
        for _, look, _, first, count, first_triangle, triangles in scene.patches:
            own = scene.vertices[first:first + count]
            corners = scene.triangles[first_triangle:first_triangle + triangles]
            print("mesh2 { vertex_vectors {", count, ",", ",".join(vector(v[:3]) for v in own),
                  "} normal_vectors {", count, ",", ",".join(vector(v[3:]) for v in own),
                  "} face_indices {", triangles, ",",
                  ",".join(f"<{a - first},{b - first},{c - first}>" for a, b, c in corners),
                  "} pigment { rgb", vector(scene.looks[look]), "} no_shadow }", file=file)


def mirrored(numbers):
    """Tachyon's pictures are the other way round."""
    x, y, z = numbers
    return words((-x, y, z))


def write_tachyon(scene, path):
    with open(path, "w") as file:
        print(f"""BEGIN_SCENE
RESOLUTION {scene.width} {scene.height}
CAMERA ZOOM {scene.scale / scene.height} ASPECTRATIO 1 ANTIALIASING 0 RAYDEPTH 1
CENTER 0 0 0 VIEWDIR 0 0 -1 UPDIR 0 1 0 END_CAMERA
DIRECTIONAL_LIGHT DIRECTION {mirrored(-c for c in scene.to_light)} COLOR {words(scene.light)}
BACKGROUND {words(scene.background)}""", file=file)
        for number, look in enumerate(scene.looks):
            print(f"TEXDEF look{number} AMBIENT {scene.ambient} DIFFUSE {scene.diffuse} SPECULAR 0 OPACITY 1 "
                  f"PHONG PLASTIC {scene.specular} PHONG_SIZE {scene.exponent} COLOR {words(look)} TEXFUNC 0", file=file)
        for _, look, _, _, _, first, count in scene.patches:
            for corners in scene.triangles[first:first + count]:
                a, c, b = (scene.vertices[corner] for corner in corners)
                print("STRI V0", mirrored(a[:3]), "V1", mirrored(b[:3]), "V2", mirrored(c[:3]), "N0", mirrored(a[3:]),
                      "N1", mirrored(b[3:]), "N2", mirrored(c[3:]), f"look{look}", file=file)
        print("END_SCENE", file=file)


# Name, program, writer, command, what tells the seconds.
TRACERS = [
    ("POV-Ray", "povray", write_pov, "povray -D -V +FP8 File_Gamma=1 -A +WT{threads} +W{w} +H{h} +I{scene} +O{picture}",
     r"Trace Time:.*\(([\d.]+) seconds\)"),
    ("Tachyon", "tachyon", write_tachyon,
     "tachyon {scene} -mediumshade -shade_phong -numthreads {threads} -format PPM -o {picture}", r"Ray Tracing Time: *([\d.]+)")]


def trace(mesh, threads, processors, folder):
    """For each tracer that is installed its name, milliseconds and picture."""
    scene = Scene(mesh)
    for name, program, write, command, seconds in TRACERS:
        if not shutil.which(program):
            continue
        files = {"scene": os.path.join(folder, program + ".scene"), "picture": os.path.join(folder, program + ".ppm")}
        write(scene, files["scene"])
        output = subprocess.run(command.format(threads=threads, w=scene.width, h=scene.height, **files).split(),
                                preexec_fn=lambda: os.sched_setaffinity(0, processors), cwd=folder,
                                stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True).stdout
        found = re.search(seconds, output)
        if not found:
            raise Trouble(f"{name}: {output[-500:]}")
        yield name, 1000 * float(found.group(1)), files["picture"]
