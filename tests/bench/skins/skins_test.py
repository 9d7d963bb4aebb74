"""mars bench skins on a few small figures; its twins draw nearly the same picture. Takes: the build's folder."""
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

HERE = pathlib.Path(__file__).parent
sys.path.insert(0, str(HERE))
import skins  # noqa: E402

BUILD = pathlib.Path(sys.argv.pop(1))


class Skins(unittest.TestCase):
    def test_prints_both_and_their_ratio(self):
        with tempfile.TemporaryDirectory() as folder:
            output = pathlib.Path(folder) / "measured.json"
            printed = subprocess.run(
                [BUILD / "bench" / "skins" / "run", "--figures", "2", "--triangles", "600", "--size", "96x54", "--rounds",
                 "2", "--columns", "1", "-o", output], check=True, capture_output=True, text=True, timeout=50).stdout
            self.assertRegex(printed, r"1 processor: skinned [\d.]+ \([\d.]+\), rigid [\d.]+ \([\d.]+\)"
                                      r".*; skinned / rigid [\d.]+, dual / skinned [\d.]+")
            measured = json.loads(output.read_text())["1"]
            self.assertLessEqual({"skinned", "rigid", "dual"}, set(measured))
            self.assertTrue(all(len(milliseconds) == 2 for milliseconds in measured.values()))

    def test_twins_have_the_same_faces(self):
        bent, rigid = skins.skinned(600), skins.rigid(600)
        faces = len(bent["shapes"]["body"]["mesh"]["faces"])
        self.assertEqual(sum(len(shape["mesh"]["faces"]) for shape in rigid["shapes"].values()), faces)
        self.assertTrue(all(2 <= len(pairs) <= 8 for pairs in bent["shapes"]["body"]["mesh"]["bones"]))


if __name__ == "__main__":
    unittest.main()
