#!/usr/bin/env python3
"""Draws one keyframe of each trace (mars render --trace) to one time scale: the steps of the host and of each node, and
below them their messages (dark) and waits (grey). Pale is what belongs to other frames. Arrows are messages: sums
orange, triangles and their edge boxes red, CZB purple, strips blue, others grey.

usage: trace_picture.py TRACE [TRACE ...] -o PICTURE.png [--titles TITLE ...] [--keyframe N]

Without --keyframe: the one that takes the nodes the median time. Needs gnuplot."""
import argparse
import json
import subprocess
import sys

WIDTH, ROW, LEFT, RIGHT, TOP, BOTTOM = 1500, 26, 90, 20, 34, 46  # pixels
LETTER = 7  # pixels of a letter
PALE = 0.35
COLORS = {"dice": "#8fb7e8", "sum": "#f2b36b", "map": "#c9c9f5", "exchange": "#ef8f8f", "fill": "#b5d991",
          "scanline": "#7fcdbb", "shadow": "#9c8fb5", "depth": "#d5a6e0", "credit": "#e8e08f", "strip": "#9ecae1", "compose": "#74a9cf",
          "prepare": "#d0d1e6", "give": "#a6bddb"}
WAITING, MESSAGE, OTHER = "#cccccc", "#555555", "#eeeeee"
ARROWS = {"Strip": "#2171b5", "triangles": "#cb181d", "edge boxes": "#cb181d", "sums": "#e08214", "CZB": "#88419d"}


class Keyframe:
    """What a trace holds of one keyframe; times in milliseconds from its beginning."""

    def __init__(self, path, number):
        with open(path) as file:
            trace = json.load(file)
        self.host = trace["otherData"]["nodes"]
        events = [e for e in trace["traceEvents"] if e["ph"] in "Xsf" and e["tid"] == 1]
        spans = {}
        for event in events:
            if event["ph"] == "X" and event["name"].startswith("keyframe "):
                spans.setdefault(int(event["name"].split()[1]), []).append(event)
        self.number = self.middle(spans) if number is None else number
        if self.number not in spans:
            sys.exit(f"{path}: has no keyframe {self.number}")
        begin = min(e["ts"] for e in spans[self.number])
        composed = [e["ts"] + e["dur"] for e in events if e.get("name") == "compose" and
                    e["args"].get("frame") == self.number]
        end = max([e["ts"] + e["dur"] for e in spans[self.number]] + composed)
        inside = [e for e in events if e["ts"] < end and e["ts"] + e.get("dur", 0) > begin]
        for event in inside:
            event["begin"] = (event["ts"] - begin) / 1000
            event["end"] = event["begin"] + event.get("dur", 0) / 1000
        self.milliseconds = (end - begin) / 1000
        self.nodes_milliseconds = self.length(spans[self.number])
        self.bars = [e for e in inside if e["ph"] == "X" and not e["name"].startswith(("keyframe ", "inbetween "))]
        begun = {e["id"]: e for e in inside if e["ph"] == "s"}
        self.arrows = [(begun[e["id"]], e) for e in inside if e["ph"] == "f" and e["id"] in begun]

    @staticmethod
    def length(spans):
        return (max(e["ts"] + e["dur"] for e in spans) - min(e["ts"] for e in spans)) / 1000

    def middle(self, spans):
        return sorted(spans, key=lambda number: self.length(spans[number]))[len(spans) // 2]

    def rows(self):
        """From the top: the host, then the nodes."""
        return [self.host] + list(range(self.host))


class Drawing:
    """gnuplot's commands; x in milliseconds, y in rows from the top."""

    def __init__(self, keyframes, titles, output):
        self.most = max(k.milliseconds for k in keyframes)
        self.per_pixel = self.most / (WIDTH - LEFT - RIGHT)
        self.commands = []
        y = 0
        for keyframe, title in zip(keyframes, titles):
            y = self.panel(keyframe, title, y)
        height = TOP + BOTTOM + int(y * ROW)
        self.commands = [
            f"set terminal pngcairo size {WIDTH},{height} font 'Sans,9'", f"set output {quoted(output)}",
            f"set lmargin at screen {LEFT / WIDTH}", f"set rmargin at screen {1 - RIGHT / WIDTH}",
            f"set tmargin at screen {1 - TOP / height}", f"set bmargin at screen {BOTTOM / height}",
            f"set xrange [0:{self.most}]", f"set yrange [{y}:0]", "unset ytics", "set border 1", "set xtics nomirror out",
            "set grid xtics linecolor '#dddddd'", "set xlabel 'ms'", "unset key"
        ] + self.commands + ["plot -1 notitle"]

    def panel(self, keyframe, title, y):
        self.label(title, 0, y + 0.4, "left", "Sans Bold,10")
        y += 1
        tops = {}
        for rank in keyframe.rows():
            tops[rank] = y
            self.label("host" if rank == keyframe.host else f"node {rank}", -6 * self.per_pixel, y + 0.5, "right")
            y += 2
        for bar in keyframe.bars:
            self.bar(bar, tops[bar["pid"]], 1 if bar["args"].get("frame", keyframe.number) == keyframe.number else PALE)
        for begin, end in keyframe.arrows:
            if begin["pid"] != end["pid"]:
                self.arrow(begin, end, tops)
        return y + 0.3

    def bar(self, event, top, density):
        kind, name = event["cat"], event["name"]
        begin, end = max(event["begin"], 0), min(event["end"], self.most)
        color = {"wait": WAITING, "message": MESSAGE}.get(kind) or COLORS.get(name, OTHER)
        y, height = (top, 0.9) if kind == "phase" else (top + 0.95, 0.4)
        self.commands.append(f"set object rect from {begin},{y} to {end},{y + height} front fillcolor rgb '{color}' "
                             f"fillstyle transparent solid {density} noborder")
        if kind == "phase":
            text = f"{name} {end - begin:.1f}"
            for fitting in (text, name):
                if len(fitting) * LETTER * self.per_pixel < end - begin:
                    self.label(fitting, (begin + end) / 2, y + 0.45, "center")
                    break

    def arrow(self, begin, end, tops):
        color = ARROWS.get(begin["name"], "#888888")
        self.commands.append(f"set arrow from {max(begin['begin'], 0)},{tops[begin['pid']] + 1.15} to "
                             f"{min(end['begin'], self.most)},{tops[end['pid']] + 1.15} front size screen 0.005,20 "
                             f"filled linecolor rgb '{color}'")

    def label(self, text, x, y, side, font="Sans,9"):
        self.commands.append(f"set label {quoted(text)} at {x},{y} {side} front font '{font}'")


def quoted(text):
    return "'" + text.replace("'", "''") + "'"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("traces", nargs="+", metavar="TRACE")
    parser.add_argument("-o", required=True, dest="output", metavar="PICTURE.png")
    parser.add_argument("--titles", nargs="+", help="one for each trace")
    parser.add_argument("--keyframe", type=int)
    wanted = parser.parse_args()
    keyframes = [Keyframe(path, wanted.keyframe) for path in wanted.traces]
    titles = wanted.titles or [f"{path}, keyframe {k.number}" for path, k in zip(wanted.traces, keyframes)]
    if len(titles) != len(keyframes):
        parser.error("as many titles as traces")
    titles = [f"{title}: the nodes are done after {k.nodes_milliseconds:.1f} ms, the host after {k.milliseconds:.1f} ms"
              for title, k in zip(titles, keyframes)]
    drawing = Drawing(keyframes, titles, wanted.output)
    subprocess.run(["gnuplot"], input="\n".join(drawing.commands), text=True, check=True)


if __name__ == "__main__":
    main()
