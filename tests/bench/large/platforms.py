"""Platform files as the bench wants them: checked-in ones, and those whose nodes write the frames themselves."""
import json

FREE = 1e15  # bytes a second


def write_variant(build, name, writer, path):
    """With "nodes" a frame's file is charged to the node that drew it, and the host and its link carry no pixels."""
    folder = build / "share" / "mars" / "platforms"
    platform = json.loads((folder / f"{name}.json").read_text())
    if isinstance(platform["work"], str):
        platform["work"] = json.loads((folder / f"{platform['work']}.json").read_text())["work"]
    platform["host"]["files"] = True
    if writer == "nodes":
        work = platform["work"]
        work["node_frame"], work["node_frame_byte"] = work["sink_frame"], work["sink_byte"]
        for name_of_work in ("sink_frame", "sink_byte", "host_run", "host_byte", "host_restored", "host_frame"):
            work[name_of_work] = 0.0
        platform["network"]["host_rate"] = FREE
    path.write_text(json.dumps(platform, indent=2) + "\n")
    return platform
