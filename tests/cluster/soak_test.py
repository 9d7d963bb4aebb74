"""A short `mars bench soak`: a film ends with all its frames, whatever fails meanwhile."""

import subprocess
import unittest

from virtual_cluster import CANNOT, CLUSTER, PROGRAMS, ProgramTest, run_on_cluster

MOST = 850  # seconds for all


class Soak(ProgramTest):
    FOLDERS = "/var/tmp"

    def test_twelve_faults(self):
        command = [PROGRAMS / "mars", "bench", "soak", "--count", "12", "--every", "8", "--frames", "240",
                   "--seed", "16", "-o", "soak"]
        done = subprocess.run(command, cwd=self.folder, env=CLUSTER, capture_output=True, text=True, timeout=MOST)
        if any(why in done.stderr for why in CANNOT):
            raise unittest.SkipTest(done.stderr.strip())
        self.assertEqual(done.returncode, 0, f"{done.stdout}\n{done.stderr}")
        self.assertRegex(done.stdout, "all frames, the same pixels: [0-9a-f]{32}")


if __name__ == "__main__":
    run_on_cluster()
