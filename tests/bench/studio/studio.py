#!/usr/bin/env python3
"""mars bench studio: how fast the studio answers a hand. It starts `mars studio` and a
headless Chromium, moves the mouse by the DevTools protocol, and reads in the page how
long it takes from an event to the paint that shows it, at 1280x720.

Of each case: pictures a second; milliseconds to the paint, in the middle and at the
95th percentile; where the time of a picture goes, in the middle (to the message's
departure; until its picture comes; until the page's animation frame; its script; the
paint); kB a picture; processor milliseconds that each program takes for a picture.

"slow": one view over a link of 5 Mbit/s that takes 50 ms each way. Nothing may queue:
the last second's latency is about the first's, and moves have no picture of their own.
Then the mouse rests, and the exact picture must come.

"man" is a film with the library's man alone. With --figure FILE there are also cases
"figure", a film with the figure of this file (GLB, FBX, ...) in his place, as tall as
he is; with --rounds the cases take turns."""
import argparse
import os
import pathlib
import queue
import shutil
import statistics
import subprocess
import sys
import tempfile
import threading
import time

HERE = pathlib.Path(__file__).resolve().parent
SOURCES = HERE.parent.parent.parent
sys.path.insert(0, str(SOURCES / "tests" / "programs"))
from studio_browser import Browser, Proxy, Studio, tree_of  # noqa: E402

SECONDS = 4      # of each case
MOVES = 60       # of the mouse, a second
REACH = 60       # pixels to each side
CASES = ["demo drag one", "demo drag four", "demo orbit one", "demo orbit four",
         "s2 drag one", "s2 drag four", "s2 orbit one", "s2 orbit four",
         "demo drag slow", "demo orbit slow", "man drag one", "man orbit one"]
FIGURE_CASES = ["figure drag one", "figure orbit one"]
HEIGHT = "5.1"   # of the library's man
DRAGGED = {"s2": " z ", "demo": "thigh", "man": "forearm", "figure": "ForeArm"}  # is in the text of what is dragged
TARGETS = {("demo", "drag"): (50, 30), ("s2", "drag"): (100, 30), ("demo", "orbit"): (None, 24),
           ("s2", "orbit"): (None, 12)}
PROGRAMS = {"nodes": "/mars-threads ", "studio": "/mars studio", "page": "--type=renderer",
            "paint": "--type=gpu-process", "browser": "chromium/chromium",
            "driver": "chromedriver"}  # a word of its command line
SLOW_BYTES = 5e6 / 8    # a second
SLOW_DELAY = 0.05       # seconds each way
SLOW_BURST = 8192       # bytes


def arguments():
    parser = argparse.ArgumentParser(prog="mars bench studio", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("cases", nargs="*", metavar="CASE", help=f"words that cases have; all: {', '.join(CASES)}")
    parser.add_argument("--figure", type=pathlib.Path, metavar="FILE",
                        help="a figure with Mixamo's names, for the cases " + ", ".join(FIGURE_CASES))
    parser.add_argument("--rounds", type=int, default=1, metavar="N", help="of all cases; default: %(default)s")
    parser.add_argument("--build", required=True, type=pathlib.Path, help=argparse.SUPPRESS)
    parser.add_argument("--seconds", type=float, default=SECONDS, help="of a case; default: %(default)s")
    return parser.parse_args()


def kind_of(words):
    line = " ".join(words)
    return next((kind for kind, word in PROGRAMS.items() if word in line), "")


def processor_ms(*roots):
    """By kind of program."""
    spent = dict.fromkeys(PROGRAMS, 0.0)
    tick = 1000 / os.sysconf("SC_CLK_TCK")
    for root in roots:
        for process, words in tree_of(root).items():
            kind = kind_of(words)
            if not kind:
                continue
            try:
                stat = pathlib.Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()
            except OSError:
                continue
            spent[kind] += tick * (int(stat[11]) + int(stat[12]))
    return spent


class SlowLink(Proxy):
    """A token bucket and a delay, of each direction its own."""

    def carry(self, one, other):
        under_way = queue.Queue()
        threading.Thread(target=self.deliver, args=(under_way, other), daemon=True).start()
        free = time.monotonic()
        try:
            while data := one.recv(SLOW_BURST):
                free = max(free, time.monotonic() - SLOW_BURST / SLOW_BYTES) + len(data) / SLOW_BYTES
                time.sleep(max(0, free - time.monotonic()))
                under_way.put((free + SLOW_DELAY, data))
        except OSError:
            pass
        under_way.put((free + SLOW_DELAY, None))

    def deliver(self, under_way, other):
        while True:
            due, data = under_way.get()
            time.sleep(max(0, due - time.monotonic()))
            if data is None:
                return self.end(other)
            try:
                other.sendall(data)
            except OSError:
                return self.end(other)


class MeasuredBrowser(Browser):
    """Its page is without settled.js, whose work on messages and timers would be measured too."""

    SETTLED = ""

    def settle(self):
        """Until the studio has said what is under the mouse, over a slow link too."""
        time.sleep(2 * SLOW_DELAY + 0.05)


def move_for(browser, at, seconds):
    """To and fro, MOVES times a second; how often."""
    began, moves = time.monotonic(), 0
    while (now := time.monotonic() - began) < seconds:
        phase = now / 2 % 1
        off = REACH * (4 * abs(phase - 0.5) - 1)
        browser.move(round(at[0] + off), round(at[1] + off / 3))
        moves += 1
        time.sleep(max(0, began + moves / MOVES - time.monotonic()))
    return moves


def middle(values):
    return statistics.median(values) if values else float("nan")


def percentile(values, share):
    values = sorted(values)
    return values[min(len(values) - 1, int(share * len(values)))] if values else float("nan")


def film_in(folder, name, mars, figure):
    folder = pathlib.Path(folder)
    if name not in ("man", "figure"):
        shutil.copytree(SOURCES / "examples", folder, dirs_exist_ok=True)
        return folder / f"{name}.json"
    model, film = name, folder / "film.json"
    if name == "figure":
        model = "figure.json"
        subprocess.run([mars, "import", figure.resolve(), "-o", folder / model, "--height", HEIGHT], check=True, stdout=subprocess.PIPE)
    for words in (["new"], ["add", "someone", "--model", model]):
        subprocess.run([mars, "film", film, *words], check=True, stdout=subprocess.PIPE, cwd=folder)
    return film


def measure(build, case, seconds, figure):
    film, how, views = case.split()
    with tempfile.TemporaryDirectory() as folder, \
            Studio(build / "bin", film_in(folder, film, build / "bin" / "mars", figure)) as studio, \
            MeasuredBrowser(script=(HERE / "probe.js").read_text()) as browser:
        browser.open(SlowLink(studio.link).link if views == "slow" else studio.link)
        browser.until("pictures", "document.querySelectorAll('.view .waiting[hidden]').length === 4")
        browser.run("document.querySelector('[data-key=view-3]').focus()")
        if views != "four":
            browser.run("document.querySelectorAll('.view .maximise')[3].click()")
        time.sleep(1.5)
        view = browser.run("return document.querySelector('[data-key=view-3]')")
        at = browser.find(view, DRAGGED[film])
        browser.move(*at)
        dragged = browser.run("return arguments[0].querySelector('.tip').textContent", view).split(" ")[0]
        browser.press(*at, "left" if how == "drag" else "middle")
        move_for(browser, at, 1)  # the interval has begun
        roots = studio.process.pid, browser.driver.service.process.pid
        browser.run("window.marsLatencies.length = 0; window.marsProbe.pictures.length = 0")
        before, began = processor_ms(*roots), time.monotonic()
        moves = move_for(browser, at, seconds)
        after, lasted = processor_ms(*roots), time.monotonic() - began
        latencies = [each["ms"] for each in browser.run("return window.marsLatencies") if each["view"] == 3]
        pictures = browser.run("""
            const {sent, pictures} = window.marsProbe;
            return pictures.filter(({said}) => said).map((each) => ({...each, left: sent.get(each.edit) ?? null}));""")
        browser.release(*at)
        exact = until_exact(browser) if views == "slow" else None
        complaints = browser.console()
    print(f"{case}: {how}s at {dragged}", flush=True)
    report(case, lasted, moves, latencies, pictures, {k: after[k] - before[k] for k in after}, complaints)
    if views == "slow":
        report_slow(latencies, lasted, pictures, exact)
    return None


def until_exact(browser):
    """Seconds after which the page shows the picture of a scene at rest without losses."""
    began = time.monotonic()
    browser.until("the exact picture", EXACT)
    return time.monotonic() - began


def report_slow(latencies, lasted, pictures, exact):
    second = max(1, round(len(latencies) / lasted))
    sent = sum(each["bytes"] for each in pictures) / 1000 / lasted
    print(f"    p95 of the first second {percentile(latencies[:second], 0.95):.0f}, of the last "
          f"{percentile(latencies[-second:], 0.95):.0f}; most {max(latencies):.0f}; kB/s {sent:.0f} of "
          f"{SLOW_BYTES / 1000:.0f}; exact after {exact:.1f} s", flush=True)


# Its last picture rests, and rows to the last were painted without losses since any with losses.
EXACT = """(() => {
  const painted = window.marsProbe.pictures.filter(({view, said}) => view === 3 && said);
  return (painted.at(-1)?.flags & 1) === 1 && painted.findLast(({toEnd}) => toEnd)?.encoding !== 2;
})()"""
def report(case, lasted, moves, latencies, pictures, spent, complaints):
    ours = [each for each in pictures if each["view"] == 3]
    known = [each for each in ours if each["left"] is not None and each.get("frame")]
    if not ours:
        print(f"{case}: no pictures", complaints)
        return
    row = {
        "moves/s": moves / lasted, "pict/s": len(ours) / lasted, "all/s": len(pictures) / lasted,
        "p50": middle(latencies), "p95": percentile(latencies, 0.95),
        "server": middle([each["came"] - each["left"] for each in known]),
        "frame": middle([each["frame"] - each["came"] for each in known]),
        "put": middle([each["paint"] for each in known]),
        "script": middle([each["script"] for each in known]),
        "paint": middle([each["said"] - each["frame"] - each["script"] for each in known]),
        "kB": middle([each["bytes"] for each in ours]) / 1000, "rects": middle([each["rects"] for each in ours]),
        "enc": max(each["encoding"] for each in ours),
    }
    row |= {f"cpu {kind}": value / len(pictures) for kind, value in spent.items()}
    latest, fewest = TARGETS.get(tuple(case.split()[:2]), (None, None))
    wanted = f"p95 {latest}, " if latest else ""
    aim = f" (wanted: {wanted}pict/s {fewest})" if fewest and not case.endswith("slow") else ""
    print(f"{case}{aim}\n   " + "  ".join(f"{k} {v:.1f}" for k, v in row.items()), *complaints, flush=True)


def main():
    wanted = arguments()
    known = CASES + (FIGURE_CASES if wanted.figure else [])
    cases = [case for case in known if all(word in case.split() for word in wanted.cases)]
    if not cases:
        sys.exit(f"mars bench studio: no case has all of the words {' '.join(wanted.cases)}; all: {', '.join(known)}")
    print(f"{os.cpu_count()} processors, load {os.getloadavg()[0]:.1f}")
    for case in cases * wanted.rounds:
        measure(wanted.build.resolve(), case, wanted.seconds, wanted.figure)


if __name__ == "__main__":
    main()
