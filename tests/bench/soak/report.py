"""What came of a soak: what is wrong, and a summary for people."""
from one_machine import HERE


def wrong(report):
    """What is not as it should be, each as a line."""
    if report["frames_there"] != report["frames"]:
        yield f"{report['frames'] - report['frames_there']} frames are missing"
    if report["hash"] != report["undisturbed_hash"]:
        yield f"other pixels than undisturbed: {report['hash']}"
    what = {fault["number"]: fault["what"] for fault in report["faults"]}
    for start in report["starts"]:
        if start["how"] == "failed":
            faults = "; ".join(f"{number} {what[number]}" for number in start["faults"][-3:])
            yield (f"mars ended with {start['code']} after {start['ended']:.0f} s: "
                   f"{start['last']} (last faults: {faults or 'none'})")
    if report["given_up"]:
        yield "given up: " + report["given_up"]
    if report["starts"] and report["starts"][-1]["how"] != "well":
        yield "no mars ended well"
    if report["processes_left"]:
        yield f"still running: {', '.join(report['processes_left'])}"
    for host, names in report["files_left"].items():
        if not may_be_left(host, report["faults"]):
            yield f"files left on {host}: {', '.join(names)}"
    for name in report["in_folder"]:
        if name not in ("frames.json", "film.mars"):
            yield f"left in the film's folder: {name}"
    for program, growth in report["growth"].items():
        if growth["grew"]:
            yield f"{program} grew: memory {growth['memory_kb']} kB, descriptors {growth['descriptors']}"


def may_be_left(host, faults):
    """What Open MPI's daemons of a cluster leave when they are killed: on their machine nobody else clears away."""
    return host != HERE and any(fault["kills"] in ("mpirun", "orted") for fault in faults)


def counted(words):
    return ", ".join(f"{word} {words.count(word)}" for word in sorted(set(words)))


def summary(report):
    faults = report["faults"]
    lines = [f"seed {report['seed']}: {report['frames']} frames, {len(faults)} faults in {report['seconds']:.0f} s and "
             f"{report['rounds']} rounds; undisturbed by threads {report['undisturbed_seconds']:.0f} s",
             "faults: " + counted([fault["kind"] for fault in faults]) +
             "; moments: " + counted([fault["moment"] for fault in faults]) +
             ("; not on one machine: " + ", ".join(report["skipped"]) if report["skipped"] else ""),
             f"mars was started {len(report['starts'])} times: " + counted([each["how"] for each in report["starts"]]) +
             f"; everything had ended {report['settled_seconds']:.1f} s after its end",
             f"mars verify found {len(report['wrong_frames'])} wrong frames" +
             "".join(f"\n    {frame}: {why}" for frame, why in report["wrong_frames"].items())]
    lines += [f"{len(names)} files are left on {host}" for host, names in report["files_left"].items()]
    lines += [f"{program}: of {growth['processes']} processes that lived long enough, the most that one grew: "
              f"memory of its own {growth['memory_kb'][0]:.0f} to {growth['memory_kb'][1]:.0f} kB, descriptors "
              f"{growth['descriptors'][0]:.0f} to {growth['descriptors'][1]:.0f}"
              for program, growth in sorted(report["growth"].items())]
    lines += [f"WRONG: {wrong}" for wrong in report["wrong"]] or [f"all frames, the same pixels: {report['hash']}"]
    return "\n".join(lines)
