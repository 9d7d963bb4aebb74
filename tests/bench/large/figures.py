"""What a run's report says about the whole film, and the floors below which no run can come."""

NODE_PHASES = ("dice", "map", "fill", "scanline", "shadow", "compose")  # computing; the others wait or exchange


def frames_of(report, kind):
    return [frame for frame in report["frames"] if frame["kind"] == kind]


def node_seconds(frames, phases):
    return sum(node["seconds"][phase] for frame in frames for node in frame["nodes"] for phase in phases)


def work_of(frames, count):
    return sum(node["work"][count] for frame in frames for node in frame["nodes"])


def span_of(frame):
    """A keyframe's seconds on its slowest node, waiting for the host left out."""
    return max(sum(seconds for phase, seconds in node["seconds"].items() if phase != "credit")
               for node in frame["nodes"])


def floors_of(report, platform, nodes, size):
    frames, work = report["frames"], platform["work"]
    host, storage = report["host"], platform["storage"]
    written = (host["files"] * work["file"] + host["encoded_bytes"] * work["encoded_byte"] +
               host["file_bytes"] * work["file_byte"])
    file_bytes = report["width"] * report["height"] * 4 * storage.get("file_part", 0.1)
    bytes_to_host = work_of(frames, "bytes_to_host")
    network = platform["network"]
    return {
        "compute": node_seconds(frames, NODE_PHASES) / nodes,
        "link": bytes_to_host / network.get("host_rate", network["rate"]),
        "sinks": written / platform["host"]["processors"],
        "storage": len(frames) * max(1 / storage["openings"], file_bytes / storage["rate"]),
        "host": sum(units * work.get(kind, 0) for kind, units in report["host"]["charged"].items()),
    }


def figures_of(report, platform, nodes, size):
    keyframes, inbetweens = frames_of(report, "keyframe"), frames_of(report, "inbetween")
    spans = sorted(span_of(frame) for frame in keyframes)
    film = report["total_seconds"]
    return {
        "film_seconds": film, "load_seconds": report["load_seconds"],
        "keyframe_seconds": spans[len(spans) // 2],
        "keyframe_phases": {phase: max(node["seconds"][phase] for node in keyframes[-1]["nodes"])
                            for phase in keyframes[-1]["nodes"][0]["seconds"]},
        "inbetween_seconds": node_seconds(inbetweens, NODE_PHASES) / max(len(inbetweens), 1),
        "inbetweens_a_second": len(inbetweens) / film,
        "credit_seconds": node_seconds(report["frames"], ["credit"]) / nodes,
        "bytes_to_host": work_of(report["frames"], "bytes_to_host"),
        "bytes_to_nodes": work_of(keyframes, "bytes_to_nodes"),
        "floors": floors_of(report, platform, nodes, size),
    }
