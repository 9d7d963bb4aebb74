"""What shadows add to the messages of all nodes: films with and without lights that cast, each node on a machine of its
own. Counted by bench-traffic, so the figures are exact and the same each time."""
import json
import os

import messages_sent

EXAMPLES = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "..", "examples")
FILMS = ("s3s", "demo")  # whose first light casts
FRAMES = 12
BETWEEN_NODES = ("sums", "triangles", "CZB")
HEAD = f"{'film':<6}{'nodes':>6}  {'shadows':<8}{'messages':>9}{'MB':>9}{'still, MB':>11}{'to the host, MB':>17}"


def film_of(name, casts, size, folder):
    with open(os.path.join(EXAMPLES, name + ".json")) as file:
        film = json.load(file)
    film.update(size=size, frames=FRAMES)
    film["lights"][0]["shadow"] = casts
    film["models"] = {name: os.path.join(EXAMPLES, model) if isinstance(model, str) else model
                      for name, model in film["models"].items()}
    path = os.path.join(folder, f"{name}-{casts}.json")
    with open(path, "w") as file:
        json.dump(film, file)
    return path


def traffic_of(build, film, nodes):
    """{kind: Sent of all nodes, a frame}."""
    program = os.path.join(build, "bench", "traffic", "bench-traffic")
    rows = messages_sent.rows_of(messages_sent.counted(program, film, nodes, 1, "all"), nodes)
    return {row: messages_sent.Sent(*(sum(each) / FRAMES for each in zip(*of_nodes))) for row, of_nodes in rows}


def show(build, numbers_of_nodes, size, folder):
    print(f"Frames 0 to {FRAMES - 1} of {size[0]}x{size[1]}, all nodes, a frame:")
    print(HEAD)
    for name in FILMS:
        for nodes in numbers_of_nodes:
            for casts in (False, True):
                rows = traffic_of(build, film_of(name, casts, size, folder), nodes)
                messages, _, size_sent = map(sum, zip(*(rows[kind] for kind in BETWEEN_NODES)))
                print(f"{name:<6}{nodes:>6}  {'with' if casts else 'without':<8}{messages:>9.0f}{size_sent / 1e6:>9.2f}"
                      f"{rows['CZB'].bytes / 1e6:>11.2f}{rows['Strip'].bytes / 1e6:>17.3f}", flush=True)
