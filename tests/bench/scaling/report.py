"""The report of a study: one HTML file with all in it, and its pictures as files."""
import os
from html import escape

import findings
import plots
import table
from results import STEPS, WAITS

HERE = os.path.dirname(os.path.abspath(__file__))
DRAWN = ("Dots are medians, bars their quartiles, circles the best runs: all relative to the first point's median. Dashed, "
         "where it is fitted: Amdahl's law.")
HEADINGS = ("nodes", "best", "median", "quartiles", "speed-up", "efficiency", "serial fraction", "load ratio",
            "to nodes", "to host")


def html_table(headings, rows, caption=""):
    head = "".join(f"<th>{escape(heading)}</th>" for heading in headings)
    body = "".join("<tr>" + "".join(f"<td>{escape(str(cell))}</td>" for cell in row) + "</tr>\n" for row in rows)
    above = f"<caption>{escape(caption)}</caption>" if caption else ""
    return f"<div class='wide'><table>{above}<thead><tr>{head}</tr></thead><tbody>\n{body}</tbody></table></div>\n"


def facts(pairs):
    return "<dl>" + "".join(f"<dt>{escape(name)}</dt><dd>{escape(str(value))}</dd>\n" for name, value in pairs) + "</dl>\n"


def films(results):
    """Lines by film and kind: what one picture shows."""
    groups = {}
    for line in results.lines:
        groups.setdefault((line.series.name(), line.kind), []).append(line)
    return groups


def film_section(name, kind, lines, picture):
    heading = f"<h2>{escape(name)}, {kind} scaling</h2>\n<figure>{picture}<figcaption>{DRAWN}</figcaption></figure>\n"
    return heading + "".join(html_table(HEADINGS, [table.row_of(line, point) for point in line.points], caption_of(line))
                             for line in lines)


def caption_of(line):
    first = line.points[0].runs[0]
    size = "{}x{}".format(*first["size"])
    frames = f"{sum(first['frames'].values())} frames, {first['frames']['keyframe']} of them keyframes"
    grows = f"{size} on {findings.nodes_text(line.nodes[0])}, growing with the nodes" if line.kind == "weak" else size
    return ", ".join(filter(None, [line.choice, grows, frames, first["backend"]]))


def step_rows(line):
    frame = lambda seconds: "" if seconds is None else table.seconds_text(seconds)
    for point in line.points:
        yield (point.nodes, *(table.seconds_text(point.steps[step]) for step in STEPS),
               frame(point.frame_seconds("keyframe")), frame(point.frame_seconds("inbetween")))


def steps_section(results, picture):
    tables = "".join(html_table(("nodes", *STEPS, "a keyframe", "an inbetween"), step_rows(line), line.title)
                     for line in results.lines)
    return (f"<h2>Where the time goes</h2>\n<p>Seconds of the film that the mean node spends in each step. In cold colours "
            f"it computes; in {', '.join(WAITS[:-1])} it waits for other nodes or the host. <i>host</i> is the rest: the "
            f"node has no task, or has done its last and the host composes. In the tables, the last two columns are a node's "
            f"own time for one frame, of a keyframe that of its slowest node.</p>\n<figure>{picture}</figure>\n"
            f"<details open><summary>The figures</summary>{tables}</details>\n")


def machine_section(results):
    if len(results.hosts) < 2:
        return ""
    slow = {each.name: each for each in results.slow}
    rows = [(host, len({node["node"] for run in results.runs for node in run["per_node"] if node["host"] == host}),
             f"{slow[host].times:.2f} times as long as the others" if host in slow else "like the others")
            for host in results.hosts]
    return "<h2>Machines</h2>\n" + html_table(("machine", "most nodes", "for the same work"), rows)


def environment_section(here):
    mars, memory = here["mars"], here["memory_kib"]
    listed = lambda pairs: ", ".join(f"{name}={value}" for name, value in pairs.items()) or "none"
    return facts([
        ("machine", here["machine"]), ("processor", f"{here['cpu']}, {here['cores']} cores"),
        ("processors to use", f"{here['processors']} ({here['processors_are']})"),
        ("governor", here["governor"] or "not known"),
        ("memory", f"{memory / 2**20:.1f} GiB" if memory else "not known"), ("system", here["system"]),
        ("MPI", here["mpi"] or "none"), ("MARS", f"{mars['program']}, {mars['version']}, sources {mars['commit'] or 'not known'}"),
        ("built", ", ".join(filter(None, [mars["build_type"], mars["compiler"]])) or "not known"),
        ("machines", listed(here["hosts"]) if here["hosts"] else "none named"), ("variables", listed(here["variables"]))])


def repeat_section(results):
    text = ""
    for header in results.headers:
        text += f"<pre>{escape(header['command'])}</pre>\n" + facts([
            ("folder", header["folder"]), ("began", header["began"]),
            ("runs", f"{header['repeats']} of each configuration that count, {header['warm_up']} before that do not"),
            ("order", f"shuffled in every repeat, seed {header['seed']}"),
            ("load average", f"{results.before} before the first run")])
    return f"<h2>To repeat it</h2>\n{text}<h2>Environment</h2>\n" + "".join(map(environment_section, results.environments))


def names_of(results):
    return escape(", ".join(dict.fromkeys(line.series.name() for line in results.lines)))


def heading_section(results):
    here = results.environments[0]
    machines = "1 machine" if len(results.hosts) == 1 else f"{len(results.hosts)} machines"
    version = (here["mars"]["version"] or "mars").replace("mars", "MARS")
    summary = ", ".join([here["cpu"], machines, version, results.headers[0]["began"][:10]])
    noted = "".join(f"<li>{escape(finding)}</li>\n" for finding in findings.all_of(results))
    return (f"<header><h1>Scaling of {names_of(results)}</h1>\n<p>{escape(summary)}</p></header>\n"
            f"<section class='findings'><h2>What it shows</h2><ul>{noted}</ul></section>\n")


def part(name):
    with open(os.path.join(HERE, name)) as file:
        return file.read()


def page(results, pictures):
    sections = [film_section(name, kind, lines, pictures[f"{name}-{kind}"])
                for (name, kind), lines in films(results).items()]
    body = "".join([heading_section(results), *sections, steps_section(results, pictures["steps"]),
                    f"<h2>Balance and messages</h2>\n<figure>{pictures['balance']}</figure>\n",
                    machine_section(results), part("method.html"), repeat_section(results)])
    return (f"<!DOCTYPE html>\n<html lang='en'><head><meta charset='utf-8'><title>Scaling of {names_of(results)}</title>\n"
            f"<meta name='viewport' content='width=device-width'><style>{part('report.css')}</style></head>\n"
            f"<body>\n{body}</body></html>\n")


def write(results, folder):
    """Returns the page's file."""
    pictures = {f"{name}-{kind}": plots.scaling(lines) for (name, kind), lines in films(results).items()}
    pictures.update(steps=plots.steps(results.lines), balance=plots.balance(results.lines))
    for name, picture in pictures.items():
        with open(os.path.join(folder, f"{name.replace(' ', '-')}.svg"), "w") as file:
            file.write("<?xml version='1.0' encoding='utf-8'?>\n" + picture)
    path = os.path.join(folder, "report.html")
    with open(path, "w") as file:
        file.write(page(results, pictures))
    return path
