"""Holds the examples of figures and meshes against the programs that make them: figures_are_made.py SOURCE_FOLDER."""
import json
import pathlib
import subprocess
import sys
import tempfile

root = pathlib.Path(sys.argv[1]) / "examples"


def differs(made, kept, least=1.01e-4):
    """Whether they differ by more than the last digit, which sine and cosine leave to the machine: the fourth, in
    poses the second."""
    if isinstance(made, dict):
        return (not isinstance(kept, dict) or made.keys() != kept.keys() or
                any(differs(made[k], kept[k], 1.01e-2 if k == "pose" else least) for k in made))
    if isinstance(made, list):
        return (not isinstance(kept, list) or len(made) != len(kept) or
                any(differs(m, k, least) for m, k in zip(made, kept)))
    if isinstance(made, float) or isinstance(kept, float):
        return abs(made - kept) > least
    return made != kept


with tempfile.TemporaryDirectory() as folder:
    for maker in "make_figures.py", "make_stones.py", "make_patterns.py":
        subprocess.run([sys.executable, "-B", root / maker, folder], check=True)
    made = {path.relative_to(folder): path for path in pathlib.Path(folder).rglob("*.json")}
    assert len(made) >= 15, made
    stale = [str(name) for name, path in made.items()
             if differs(json.loads(path.read_text()), json.loads((root / name).read_text()))]
if stale:
    sys.exit(f"not as examples/make_*.py make them: {', '.join(stale)}; run them again")
