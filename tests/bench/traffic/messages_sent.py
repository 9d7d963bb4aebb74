"""Messages that ranks sent, as tables: from bench-traffic's lines or from traces of `mars render`; the host's number is
the number of nodes."""
import collections
import json
import subprocess

Sent = collections.namedtuple("Sent", "messages empty bytes")
NONE = Sent(0, 0, 0)
KINDS = ("sums", "triangles", "edge boxes", "CZB", "Strip")  # those with a row of their own; edge boxes: older programs'
MEASURING = ("Clock", "Trace")  # a traced run's own


def add(a, b):
    return Sent(*(x + y for x, y in zip(a, b)))


def counted(program, film, nodes, each, frames):
    """{(from, to, kind): Sent} of a film on threads, as bench-traffic prints it."""
    done = subprocess.run([program, film, str(nodes), str(each), frames], check=True, stdout=subprocess.PIPE, text=True)
    sent = {}
    for line in done.stdout.splitlines():
        sender, receiver, messages, empty, size, kind = line.split(" ", 5)
        sent[int(sender), int(receiver), kind] = Sent(int(messages), int(empty), int(size))
    return sent


def traced(path):
    """The same from a trace file."""
    with open(path) as file:
        trace = json.load(file)
    other = trace["otherData"]
    if other["events_beyond_bound"] or other["events_lost_by_ranks"]:
        raise SystemExit(f"{path}: the trace lacks events: trace fewer nodes or frames")
    sent = collections.defaultdict(lambda: NONE)
    for event in trace["traceEvents"]:
        if event["ph"] != "X" or not event["name"].startswith("send "):
            continue
        kind, to, size = event["name"][len("send "):], event["args"]["to"], event["args"]["bytes"]
        if kind not in MEASURING:
            key = event["pid"], other["nodes"] if to == "host" else to, kind
            sent[key] = add(sent[key], Sent(1, size == 0, size))
    return dict(sent)


def in_between(short, long, keyframes):
    """What each of `keyframes` more keyframes takes; the film's start and end drop out."""
    more = {key: Sent(*((b - a) / keyframes for a, b in zip(short.get(key, NONE), sent))) for key, sent in long.items()}
    return {key: sent for key, sent in more.items() if any(sent)}


def by_sender(sent, nodes, wanted):
    """Of each node: what it sent under the keys that are wanted."""
    sums = [NONE] * nodes
    for key, each in sent.items():
        if key[0] < nodes and wanted(key):
            sums[key[0]] = add(sums[key[0]], each)
    return sums


def rows_of(sent, nodes):
    """[(name, each node's Sent)]: a row for each kind, and their sums."""
    rows = [(kind, by_sender(sent, nodes, lambda key, kind=kind: key[2] == kind)) for kind in KINDS]
    rows.append(("to nodes", by_sender(sent, nodes, lambda key: key[1] < nodes)))
    rows.append(("to the host", by_sender(sent, nodes, lambda key: key[1] == nodes)))
    from_host = [NONE] * nodes
    for (sender, receiver, _), each in sent.items():
        if sender == nodes and receiver < nodes:
            from_host[receiver] = add(from_host[receiver], each)
    rows.append(("from the host", from_host))
    return rows


def figures(each):
    """Messages: mean, greatest; without a byte: mean; kB: mean, greatest; all nodes' MB."""
    of = lambda field: [getattr(sent, field) for sent in each]
    mean = lambda values: sum(values) / len(values)
    return (f"{mean(of('messages')):9.1f} {max(of('messages')):6.0f} {mean(of('empty')):7.1f}"
            f" {mean(of('bytes')) / 1e3:9.1f} {max(of('bytes')) / 1e3:8.1f} {sum(of('bytes')) / 1e6:7.2f}")


def show(title, tables, nodes):
    """Side by side: {name of a build: {(from, to, kind): Sent}}."""
    columns = f"{'messages':>9} {'most':>6} {'empty':>7} {'kB':>9} {'most':>8} {'MB all':>7}"
    print(title)
    print(" " * 14 + "   ".join(f"{name:<51}" for name in tables).rstrip())
    print(" " * 14 + "   ".join(columns for _ in tables))
    for rows in zip(*(rows_of(sent, nodes) for sent in tables.values())):
        print(f"{rows[0][0]:<14}" + "   ".join(figures(each) for _, each in rows))
    print(flush=True)
