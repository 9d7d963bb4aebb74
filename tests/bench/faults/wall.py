"""A film's wall time when one of its nodes dies at half, beside the ideal: the undisturbed time, and the start of a
second job, from mars's command to the first frame that a node begins. Renderings of both kinds take turns."""
import statistics
import time

import film
from kinds import KILL, LOST

FRAMES, REPEATS = 1200, 3


def render(scene, dies):
    """(seconds of the whole, seconds until the first frame was begun)"""
    scene.begin()
    if dies:
        scene.wait_for_frames(FRAMES // 2)
        scene.happens()
        scene.process("mars-node", LOST).send(KILL)
    code = scene.wait(1800)
    ended = time.monotonic()
    scene.watch.end()
    scene.cluster.wait_until_idle(60)
    if code != 0:
        raise RuntimeError(f"mars ended with {code}:\n{scene.mars.text()}")
    began = scene.mars.began
    return ended - began, scene.notes.lines()[0][0] - began


def measure(make_scene, folder, dice):
    film_file = film.write_film(folder / "wall.json", FRAMES, dice=dice)
    runs = {False: [], True: []}
    for _ in range(REPEATS):
        for dies in runs:
            runs[dies].append(render(make_scene(film_file, FRAMES), dies))
            print(f"{'one node dies' if dies else 'undisturbed'}: {runs[dies][-1][0]:.1f} s", flush=True)
    middle = lambda dies, column: statistics.median(run[column] for run in runs[dies])
    undisturbed, start, disturbed = middle(False, 0), middle(False, 1), middle(True, 0)
    return {"frames": FRAMES, "repeats": REPEATS, "undisturbed": undisturbed, "start": start, "one_dies": disturbed,
            "over_ideal": disturbed / (undisturbed + start) - 1}


def text(result):
    return (f"{result['frames']} frames: undisturbed {result['undisturbed']:.1f} s, start {result['start']:.1f} s; "
            f"with a node killed at half {result['one_dies']:.1f} s, {100 * result['over_ideal']:+.0f} % of the ideal")
