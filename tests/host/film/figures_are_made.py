"""Holds the figures' examples against the program that makes them: figures_are_made.py SOURCE_FOLDER."""
import json
import pathlib
import subprocess
import sys
import tempfile

root = pathlib.Path(sys.argv[1]) / "examples"


def differs(made, kept):
    """Whether they differ by more than a last digit, which sine and cosine leave to the machine."""
    if isinstance(made, dict):
        return not isinstance(kept, dict) or made.keys() != kept.keys() or any(differs(made[k], kept[k]) for k in made)
    if isinstance(made, list):
        return not isinstance(kept, list) or len(made) != len(kept) or any(map(differs, made, kept))
    if isinstance(made, (int, float)) and isinstance(kept, (int, float)):
        return abs(made - kept) > 0.0101
    return made != kept


with tempfile.TemporaryDirectory() as folder:
    subprocess.run([sys.executable, "-B", root / "make_figures.py", folder], check=True)
    made = {path.relative_to(folder): path for path in pathlib.Path(folder).rglob("*.json")}
    assert len(made) >= 7, made
    stale = [str(name) for name, path in made.items()
             if differs(json.loads(path.read_text()), json.loads((root / name).read_text()))]
if stale:
    sys.exit(f"not as examples/make_figures.py makes them: {', '.join(stale)}; run it again")
