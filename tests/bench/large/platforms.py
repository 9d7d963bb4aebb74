"""Platform files as the bench records them."""
import json


def platform_of(build, name):
    """A platform of the build, with its costs of work."""
    folder = build / "share" / "mars" / "platforms"
    platform = json.loads((folder / f"{name}.json").read_text())
    if isinstance(platform["work"], str):
        platform["work"] = json.loads((folder / f"{platform['work']}.json").read_text())["work"]
    return platform
