"""mars bench outputs on a small film: what it measures, and that it knows every format, compression and codec.
Takes: the build's folder."""
import json
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

HERE = pathlib.Path(__file__).parent
sys.path.insert(0, str(HERE))
import outputs  # noqa: E402

BUILD = pathlib.Path(sys.argv.pop(1))
FRAMES = 3


def film():
    box = {"joints": [{"name": "a", "segment": {"shape": "box", "sbb": [[-1, -1, -1], [1, 1, 1]]}}]}
    return {"frames": FRAMES, "size": [32, 18], "models": {"box": box}, "actors": [{"name": "a", "model": "box"}],
            "camera": {"eye": [0, -9, 0], "at": [0, 0, 0]}}


def words_of(option):
    """What an option of mars render takes, by its placeholder or its help."""
    listed = subprocess.run([BUILD / "bin" / "mars", "--list-options"], check=True, capture_output=True, text=True).stdout
    rows = [line.split("\t") for line in listed.splitlines()]
    row = next(row for row in rows if row[:3] == ["option", "mars render", option])
    if "|" in row[3]:
        return row[3].split("|")
    listed_in_help = re.search(": (.*?);", re.sub(r" \(.*?\)", "", row[5]))[1]
    return re.split(", | or ", listed_in_help)


class Outputs(unittest.TestCase):
    def test_rows(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "film.json"
            path.write_text(json.dumps(film()))
            done = subprocess.run(
                [sys.executable, "-B", HERE / "outputs.py", "--build", BUILD, path, "--rounds", "1", "--only", "png",
                 "exr none", "exr zip", "mp4 h264", "--", "--backend", "threads"],
                capture_output=True, text=True, timeout=50)
        self.assertEqual(done.returncode, 0, done.stderr)
        rows = {line[:14].strip(): line[14:].split() for line in done.stdout.splitlines()[1:]}
        self.assertEqual(list(rows)[:4], ["nothing", "png", "exr zip", "exr none"])
        self.assertEqual((rows["nothing"][2], rows["nothing"][5]), ("0", "0.00"))
        self.assertGreater(int(rows["exr none"][2]), FRAMES * 32 * 18 * 6)
        self.assertGreater(int(rows["exr none"][2]), int(rows["exr zip"][2]))
        self.assertEqual(int(rows["png"][3]), int(rows["png"][2]) // FRAMES)
        self.assertTrue("mp4 h264" in rows or "ffmpeg" in done.stderr, done.stderr)

    def test_nothing_is_left_out(self):
        names = {output.name for output in outputs.OUTPUTS}
        of_exr = {name.split()[1] for name in names if name.startswith("exr ")}
        for option, found in [("--format", {name.split()[0] for name in names}), ("--compression", of_exr),
                              ("--layers", of_exr),
                              ("--codec", {name.split()[-1] for name in names})]:
            self.assertLessEqual(set(words_of(option)), found, option)


if __name__ == "__main__":
    unittest.main()
