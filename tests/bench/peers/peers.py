#!/usr/bin/env python3
"""MARS and its peers on the same scenes, in turn, so that only ratios count; and
do all draw the same picture?

Every competitor keeps its scene loaded and renders one frame when it is its
turn, timed from the order to the last pixel in memory; of a film with files, all
frames, until the last file is closed. A column is a number of
processors: competitors have that number of threads or nodes, and may use no other
processor. README.md beside this program tells what each peer does."""
import argparse
import contextlib
import itertools
import json
import os
import platform
import statistics
import subprocess
import sys
import tempfile
import time

import films
import pictures
import ray_tracers
from competitor import Competitor, Team, Trouble

SCENES = ["s1", "s1m", "s2", "s3"]
SUNS = {"hard": 0, "soft": 0.01}  # of lights that cast, the tangent of half the angle that they take up in the sky
SUN_RAYS = 16        # to a soft one from each pixel, at least one from each sample
MOST_RMS = 0.5       # of 255, between ours and Embree's picture of the same triangles
MOST_RMS_OF_SHADOWS = 1.5  # the same, diced as the scenes are: ours fade where coarse facets turn from the light
WARMING = 5          # frames before those that count
LLVMPIPE_SAMPLES = [1, 4]    # it can do no others
ENCODERS = {"libpng": "libpng", "igzip": "ISA-L (libisal-dev)"}  # of peer-llvmpipe's files, and whose they are
KEPT = ", map kept"  # from frame to frame, in a competitor's name
FRAMES = "{frames}"  # in a command: the folder of a competitor's files
FINE = 64            # quads along a patch's side that adaptive dicing is compared with
MOST_IDLE = 0.05     # processor seconds a competitor may use in a second that is not its turn


class Course:
    """One line of the table: a scene, and what of it is rendered at every turn."""

    def __init__(self, scene, what="whole"):
        self.scene, self.what = scene, what
        self.title = {"whole": scene, "inbetween": f"{scene}'s inbetweens", "film": f"{scene}'s film with files"}[what]
        self.interval = films.FILM if what == "film" else films.INTERVAL
        self.frames_a_turn = {"whole": 1, "inbetween": films.INTERVAL - 1, "film": films.FILM}[what]

    def frames(self, turns):
        return turns if self.what == "whole" else turns * self.interval


def courses_of(scenes):
    for scene in scenes:
        yield Course(scene)
        if films.turning(films.load(scene)):
            yield Course(scene, "inbetween")
            yield Course(scene, "film")


class Heat:
    """The competitors of one course, column, number of samples and size of the sun, which is none if nothing casts."""

    def __init__(self, wanted, course, column, samples, sun, folder):
        self.programs = os.path.join(wanted.build, "bench", "peers")
        self.course, self.column, self.samples, self.sun, self.folder = course, column, samples, sun, folder
        self.processors = sorted(os.sched_getaffinity(0))[:column]
        film = films.load(course.scene, wanted.size, wanted.dice, samples, SUNS.get(sun))
        self.moves = bool(films.turning(film))
        # The film has one turn more: after its last frame no order is read.
        self.film = films.lengthened(film, course.frames(WARMING + wanted.rounds + 1), course.interval)
        self.mesh = os.path.join(folder, "mesh")
        self.make_mesh(films.lengthened(film, course.interval if self.moves else 1, course.interval))
        self.competitors = []
        self.absent = []  # competitors that cannot be, with the reason
        self.begin_peers()
        self.competes = sun is None or self.is_known(film)  # whether we do
        self.adaptive = wanted.adaptive and self.competes and not self.moves
        self.ray_tracers = wanted.ray_tracers and samples == 1 and sun is None and not self.moves
        if not self.competes:
            self.absent.append(("ours", "this MARS has no shadows"))
            return
        self.begin_ours("ours", self.film)
        if self.adaptive:
            self.begin_ours("ours, adaptive", self.diced("adaptive"))

    def save(self, film, name):
        return films.save(film, os.path.join(self.folder, name))

    def diced(self, dice):
        return {**self.film, "dice": dice}

    def program(self, name):
        path = os.path.join(self.programs, name)
        return path if os.path.exists(path) else None

    def make_mesh(self, film):
        made = self.run_mesh(films.without_shadows(film), self.mesh)
        if made.returncode != 0:
            raise Trouble(made.stderr.strip())

    def run_mesh(self, film, mesh):
        return subprocess.run([self.program("bench-mesh"), self.save(film, "mesh.json"), mesh],
                              stderr=subprocess.PIPE, text=True)

    def is_known(self, film):
        """Whether this MARS reads such a film, of one interval."""
        return self.run_mesh(film, os.devnull).returncode == 0

    def start(self, name, command, environment=None, processors=None):
        log = os.path.join(self.folder, f"{name}.log".replace(" ", "-"))
        frames = self.make_frames_folder(name) if self.course.what == "film" else None
        command = [word if word != FRAMES else frames for word in command]
        return Competitor(name, command, processors or self.processors, log, environment, frames)

    def make_frames_folder(self, name):
        return tempfile.mkdtemp(prefix=f"{name}-".replace(" ", "-"), dir=self.folder)

    def begin(self, *competitor):
        self.competitors.append(self.start(*competitor))
        return self.competitors[-1]

    def begin_peers(self):
        if self.course.what == "film":
            self.begin_writers()
            return
        embree = self.program("peer-embree")
        llvmpipe = self.program("peer-llvmpipe") if self.samples in LLVMPIPE_SAMPLES else None
        if embree:
            self.begin("Embree", self.embree_command(embree, self.column))
        # Mesa's main thread prepares what its others draw: which number is best differs from scene to scene.
        for threads in (self.column - 1, self.column) if llvmpipe else ():
            self.begin(f"llvmpipe {threads}", self.llvmpipe_command(llvmpipe, threads))
            if self.sun and not self.moves:
                self.begin(f"llvmpipe {threads}{KEPT}", self.llvmpipe_command(llvmpipe, threads, "kept-map"))
        # Inbetweens may go whole to single processors, as ours do.
        if self.course.what == "inbetween" and self.column > 1:
            self.begin_team("Embree", embree and self.embree_command(embree, 1))
            self.begin_team("llvmpipe", llvmpipe and self.llvmpipe_command(llvmpipe, 0))

    def begin_writers(self):
        """llvmpipe, whose frames are made PNG files in several ways."""
        llvmpipe = self.program("peer-llvmpipe") if self.samples in LLVMPIPE_SAMPLES else None
        if not llvmpipe:
            return
        built = subprocess.run([llvmpipe, "encoders"], stdout=subprocess.PIPE, text=True, check=True).stdout.split()
        for encoder, library in ENCODERS.items():
            if encoder not in built:
                self.absent.append((f"llvmpipe, {encoder}", f"not built: {library} was missing"))
                continue
            for threads in self.column - 1, self.column:
                self.begin(f"llvmpipe {threads}, {encoder}",
                           self.llvmpipe_command(llvmpipe, threads) + [FRAMES, encoder])

    def begin_team(self, name, command):
        if command:
            self.competitors.append(Team(f"{name}, {self.column} at a time", [
                self.start(f"{name} {processor}", command, None, [processor]) for processor in self.processors]))

    def peer_command(self, program, threads):
        return [program, self.mesh, str(threads), self.course.what, str(self.samples)]

    def embree_command(self, program, threads):
        return self.peer_command(program, threads) + [str(SUNS.get(self.sun, "none"))]

    def llvmpipe_command(self, program, threads, shadows="map"):
        return self.peer_command(program, threads) + [shadows if self.sun else "none"]

    def begin_ours(self, name, film):
        self.begin_threads(f"{name}, threads", film)
        mpi = self.program("bench-ours-mpi")
        if mpi:
            self.begin(f"{name}, MPI", ["mpirun", "-n", str(self.column + 1), mpi, self.save(film, f"{name}.json"),
                                        self.course.what, *self.folder_word()], MPI_ENVIRONMENT)

    def begin_threads(self, name, film):
        return self.begin(name, self.threads_command(self.save(film, f"{name}.json"), self.course.what))

    def threads_command(self, film, what):
        return [self.program("bench-ours-threads"), film, what, str(self.column), *self.folder_word()]

    def folder_word(self):
        return [FRAMES] if self.course.what == "film" else []

    def take_picture(self, competitor):
        file = os.path.join(self.folder, competitor.name.replace(" ", "-") + ".ppm")
        competitor.picture(file)
        return file

    def fine_picture(self):
        """What finer triangles than anybody competes with show: ours, for ours are as the peers' by then."""
        fine = self.begin_threads("fine", self.diced(FINE))
        fine.wait_ready()
        fine.go(1)
        return self.take_picture(fine)

    def latency(self):
        """Milliseconds that an inbetween of ours takes from its beginning to its frame."""
        return float(self.begin("latency", self.threads_command(self.save(self.film, "latency.json"), "latency"))
                     .answer("latency"))

    def costs(self):
        """What shadows cost each of the peers that draw alone; a map costs the same where it is kept."""
        if not self.sun or self.course.what == "film":
            return {}
        return {competitor.name: competitor.cost() for competitor in self.competitors
                if isinstance(competitor, Competitor) and not is_ours(competitor.name) and KEPT not in competitor.name}

    def end(self):
        for competitor in self.competitors:
            competitor.end()


def compete(heats, rounds):
    """All heats in turn, so that their times compare."""
    competitors = [(heat, competitor) for heat in heats for competitor in heat.competitors]
    for _, competitor in competitors:
        competitor.wait_ready()
    for turn in range(WARMING + rounds):
        for heat, competitor in competitors:
            milliseconds = competitor.go(heat.course.frames_a_turn)
            if turn >= WARMING:
                competitor.milliseconds.append(milliseconds)


def check_idle(heats):
    competitors = [competitor for heat in heats for competitor in heat.competitors]
    before = [competitor.processor_seconds() for competitor in competitors]
    time.sleep(1)
    for competitor, used in zip(competitors, before):
        if competitor.processor_seconds() - used > MOST_IDLE:
            raise Trouble(f"{competitor.name} does not rest while others render")


# Open MPI (4, then 5): more ranks than processors, bound to none, also as root as in a container.
MPI_ENVIRONMENT = {
    "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1", "OMPI_MCA_rmaps_base_oversubscribe": "1",
    "OMPI_MCA_hwloc_base_binding_policy": "none", "PRTE_MCA_rmaps_default_mapping_policy": ":oversubscribe",
    "PRTE_MCA_hwloc_default_binding_policy": "none"}


def is_ours(name):
    return name.startswith("ours")


def is_alike(row):
    """Whether it draws the triangles that the peers draw."""
    return "adaptive" not in row["name"]


def result_of(heat):
    """One heat's part of the JSON."""
    files = {competitor.name: heat.take_picture(competitor) for competitor in heat.competitors}
    reference = next(files[name] for name in ("Embree", "ours, threads", *files) if name in files)
    rows = [{"name": c.name, "note": c.note, "best": min(c.milliseconds), "middle": statistics.median(c.milliseconds),
             "milliseconds": c.milliseconds, "rms": pictures.rms(reference, files[c.name])}
            for c in heat.competitors]
    result = {"course": heat.course.title, "column": heat.column, "samples": heat.samples, "sun": heat.sun,
              "competitors": rows, "absent": heat.absent, "costs": heat.costs()}
    if heat.course.what == "inbetween" and heat.competes:
        result["latency"] = heat.latency()
    if heat.adaptive:
        fine = heat.fine_picture()
        for row in rows:
            row["rms_fine"] = pictures.rms(fine, files[row["name"]])
    if heat.ray_tracers:
        traced = ray_tracers.trace(heat.mesh, heat.column, heat.processors, heat.folder)
        result["traced"] = [{"name": name, "milliseconds": milliseconds, "rms": pictures.rms(reference, file)}
                            for name, milliseconds, file in traced]
    add_ratios(result)
    return result


def add_ratios(result):
    rows = result["competitors"]
    peers = [row for row in rows if not is_ours(row["name"])]
    if peers:
        best = min(peers, key=lambda row: row["best"])
        result["best_peer"] = best["name"]
        for row in rows:
            if is_ours(row["name"]):
                row["ratio"] = row["best"] / best["best"]


def add_costs(results):
    """To the rows of one course and column what their samples cost, in times of one sample."""
    of_one = {(row["name"], result["sun"]): row["best"]
              for result in results if result["samples"] == 1 for row in result["competitors"]}
    for result in results:
        for row in result["competitors"]:
            if result["samples"] > 1 and (row["name"], result["sun"]) in of_one:
                row["cost"] = row["best"] / of_one[row["name"], result["sun"]]


def counted(count, what):
    return f"{count} {what}{'s' if count > 1 else ''}"


def check_alike(result):
    most = MOST_RMS_OF_SHADOWS if result["sun"] else MOST_RMS
    for row in result["competitors"]:
        if is_ours(row["name"]) and is_alike(row) and row["rms"] > most:
            raise Trouble(f"{result['course']}, {counted(result['samples'], 'sample')}: the picture of {row['name']} "
                          f"differs from Embree's by {row['rms']:.2f} of 255, more than {most}")


def run_course(wanted, course, column):
    """The results of all heats."""
    with contextlib.ExitStack() as ends:
        heats = []
        suns = wanted.suns if course.scene in films.SHADOWED else [None]
        for samples, sun in itertools.product(wanted.samples, suns):
            folder = ends.enter_context(tempfile.TemporaryDirectory())
            heats.append(Heat(wanted, course, column, samples, sun, folder))
            ends.callback(heats[-1].end)
        compete(heats, wanted.rounds)
        check_idle(heats)
        results = [result_of(heat) for heat in heats]
        add_costs(results)
        return results


def sun_rays(result):
    """Of a pixel that has light, in Embree's pictures."""
    return max(SUN_RAYS if SUNS[result["sun"]] else 1, result["samples"])


def line_of(row, rms, best_peer):
    ratio = f"   {row['ratio']:.2f} of {best_peer}'s" if "ratio" in row else ""
    cost = f"   {row['cost']:.2f} of 1 sample's" if "cost" in row else ""
    return f"  {row['name']:24} {row['best']:8.2f} ({row['middle']:.2f})".ljust(48) + f"RMS {row[rms]:.2f}{cost}{ratio}"


def tell(result):
    where = f"{result['course']}, {counted(result['column'], 'processor')}, {counted(result['samples'], 'sample')}"
    if result["sun"]:
        where += f", {result['sun']} sun: {counted(sun_rays(result), 'shadow ray')} a pixel"
    print(f"\n{where}")
    for row in filter(is_alike, result["competitors"]):
        print(line_of(row, "rms", result.get("best_peer")))
    for name, reason in result["absent"]:
        print(f"  {name:24} {reason}")
    for name, cost in result["costs"].items():
        print(f"  {name:24} {cost['what']} costs {cost['amount']:.2f} {cost['unit']} ({cost['note']})")
    for row in result.get("traced", []):
        print(f"  {row['name']:24} {row['milliseconds']:8.0f}, once".ljust(48) + f"RMS {row['rms']:.2f}")
    if "latency" in result:
        print(f"  one inbetween of ours, from its beginning to its frame: {result['latency']:.2f}")
    if "rms_fine" in result["competitors"][0]:
        print(f"\n{where}: other triangles, RMS against {FINE} x {FINE} quads a patch")
        for row in result["competitors"]:
            if row["name"] == "Embree" or not is_alike(row):
                print(line_of(row, "rms_fine", result.get("best_peer")))
    sys.stdout.flush()


def processor_name():
    with open("/proc/cpuinfo") as file:
        names = [line.partition(":")[2].strip() for line in file if line.startswith("model name")]
    return names[0] if names else platform.machine()


def read_command_line():
    here = len(os.sched_getaffinity(0))

    def processors(text):
        columns = [int(n) for n in text.split(",")]
        if not all(1 <= n <= here for n in columns):
            raise argparse.ArgumentTypeError(f"there are {here} processors to use here")
        return columns

    def scenes(text):
        names = text.split(",")
        if not set(names) <= {*SCENES, *films.SHADOWED}:
            raise argparse.ArgumentTypeError(f"the scenes are {', '.join([*SCENES, *films.SHADOWED])}")
        return names

    def samples(text):
        numbers = [int(n) for n in text.split(",")]
        if not set(numbers) <= {1, 2, 4, 8, 16}:
            raise argparse.ArgumentTypeError("a pixel has 1, 2, 4, 8 or 16 samples")
        return numbers

    def suns(text):
        names = text.split(",")
        if not set(names) <= set(SUNS):
            raise argparse.ArgumentTypeError(f"the suns are {', '.join(SUNS)}")
        return names

    def size(text):
        return [int(n) for n in text.split("x")]

    parser = argparse.ArgumentParser(prog="mars bench peers", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", required=True, help=argparse.SUPPRESS)
    parser.add_argument("--scenes", default=",".join(SCENES), type=scenes,
                        help=f"with shadows: {','.join(films.SHADOWED)}")
    parser.add_argument("--suns", default=",".join(SUNS), type=suns,
                        help="of scenes with shadows: hard: a point, one shadow ray a sample; "
                             f"soft: a small disc, {SUN_RAYS} shadow rays a pixel")
    parser.add_argument("--rounds", default=15, type=int)
    parser.add_argument("--columns", default="1,2" if here > 1 else "1", type=processors, help="numbers of processors")
    parser.add_argument("--samples", default="1", type=samples, help="a pixel, as 1,4,16: each in turn with the others")
    parser.add_argument("--size", type=size, help="of the pictures, as 1920x1080")
    parser.add_argument("--dice", type=int, help="quads along a patch's side, in place of the scene's own")
    parser.add_argument("--adaptive", action="store_true", help="ours with adaptive dicing as well, where nothing moves")
    parser.add_argument("--ray-tracers", action="store_true",
                        help="also POV-Ray and Tachyon, once each, where nothing moves")
    parser.add_argument("-o", dest="output", metavar="FILE", type=argparse.FileType("w"), help="all that was measured, as JSON")
    return parser.parse_args()


def main():
    wanted = read_command_line()
    results, printed = [], 0
    print("ms a frame: best (middle)")
    for course in courses_of(wanted.scenes):
        for column in wanted.columns:
            results += run_course(wanted, course, column)
            for result in results[printed:]:
                tell(result)
            printed = len(results)
    if wanted.output:
        with wanted.output as file:
            json.dump({"machine": processor_name(), "rounds": wanted.rounds, "results": results}, file, indent=1)
    for result in results:
        check_alike(result)


if __name__ == "__main__":
    try:
        main()
    except Trouble as trouble:
        sys.exit(f"mars bench peers: {trouble}")
