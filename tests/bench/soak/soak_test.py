"""What a soak decides before it begins and concludes after it: its faults, when they are made, what they do to files,
and what has grown."""
import pathlib
import random
import stat
import sys
import tempfile
import unittest

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent / "faults")]
from cluster import Process  # noqa: E402
from damage import (OF_FRAMES, OF_RECORDS, Source, damage, flip_a_bit, make_a_folder, make_a_pipe,  # noqa: E402
                    take_away)
from growth import BEGINNING, Samples  # noqa: E402
from plan import END, NOW, SHARES, START, plan  # noqa: E402
from report import wrong  # noqa: E402
from schedule import RETRY, Schedule  # noqa: E402


class Plans(unittest.TestCase):
    def test_a_seed_decides_all(self):
        first, again, other = (plan(seed, 100, list(SHARES), 5) for seed in (1, 1, 2))
        self.assertEqual(first, again)
        self.assertNotEqual(first, other)
        self.assertEqual(first[40].dice().random(), first[40].dice().random())
        self.assertNotEqual(first[40].dice().random(), first[41].dice().random())

    def test_faults_of_all_kinds_at_all_moments(self):
        faults = plan(100, 100, list(SHARES), 5)
        self.assertEqual({fault.kind for fault in faults}, set(SHARES))
        self.assertEqual({fault.moment for fault in faults if fault.kind == "kill"}, {NOW, START, END})
        self.assertEqual({fault.moment for fault in faults if fault.kind == "frame"}, {NOW})


class Schedules(unittest.TestCase):
    def faults(self, *moments):
        faults = plan(1, len(moments), ["kill"], 1)
        for fault, moment in zip(faults, moments):
            fault.moment, fault.after, fault.delay = moment, 10, 4
        return faults

    def test_one_after_the_other(self):
        first, second = self.faults(NOW, NOW)
        schedule = Schedule([first, second], now=0)
        self.assertEqual([schedule.take(now) for now in (9, 10, 19, 20)], [[], [first], [], [second]])
        self.assertEqual(schedule.left(), 0)

    def test_what_finds_nothing_to_hit_keeps_nobody_waiting(self):
        first, second = self.faults(NOW, NOW)
        schedule = Schedule([first, second], now=0)
        schedule.put_back(schedule.take(10)[0], 10)
        self.assertEqual(schedule.take(10 + RETRY), [first])
        schedule.put_back(first, 19.9)
        self.assertEqual(schedule.take(20), [second])

    def test_a_job_that_ends_is_waited_for(self):
        fault, = self.faults(END)
        schedule = Schedule([fault], now=0)
        self.assertEqual(schedule.take(50), [])
        self.assertTrue(schedule.only_moments_left())
        schedule.come(START, 60)
        schedule.come(END, 70)
        self.assertEqual([schedule.take(now) for now in (73, 74)], [[], [fault]])
        schedule.put_back(fault, 74)
        schedule.come(END, 80)
        self.assertEqual([schedule.take(now) for now in (81, 82)], [[], [fault]])


class Damage(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = pathlib.Path(folder.name) / "frame-0001.png"
        self.path.write_bytes(bytes(range(100)))

    def test_every_way_changes_the_file(self):
        for way in {*OF_RECORDS, *OF_FRAMES}:
            self.path.write_bytes(bytes(range(100)))
            self.assertIn(self.path.name, damage(self.path, [way], random.Random(1)))
            self.assertFalse(self.path.is_file() and self.path.read_bytes() == bytes(range(100)), way)
            take_away(self.path)
            self.assertFalse(self.path.exists(), way)

    def test_a_bit_is_one(self):
        flip_a_bit(self.path, random.Random(3))
        changed = [before ^ after for before, after in zip(range(100), self.path.read_bytes())]
        self.assertEqual(sum(bin(byte).count("1") for byte in changed), 1)

    def test_what_is_no_file_of_bytes_stays(self):
        make_a_pipe(self.path, None)
        self.assertIsNone(damage(self.path, OF_FRAMES, random.Random(1)))
        self.assertTrue(stat.S_ISFIFO(self.path.stat().st_mode))
        take_away(self.path)
        self.assertIsNone(damage(self.path, OF_FRAMES, random.Random(1)))

    def test_a_folder_of_a_frame_s_name(self):
        make_a_folder(self.path, None)
        self.assertTrue(self.path.is_dir())

    def test_a_film_is_put_back(self):
        film = self.path.with_name("film.json")
        film.write_text('{"frames": 48, "background": [0, 0, 0]}\n')
        for seed in range(12):
            source = Source(film)
            source.change(random.Random(seed))
            self.assertFalse(film.exists() and film.read_text() == source.text)
            source.put_back()
            self.assertEqual(film.read_text(), source.text)


class Growth(unittest.TestCase):
    def samples(self, *lives):
        """Each a program and its (kB, descriptors)."""
        samples = Samples(None)
        samples.of = {Process(number, program, "n1"): life for number, (program, life) in enumerate(lives)}
        return samples.growth()

    def test_what_grows(self):
        found = self.samples(("mars", [(10000 + 500 * n, 9) for n in range(60)]),
                             ("mars-host", [(90000, 30 + n) for n in range(60)]),
                             ("mars-node", [(60000 + n % 7, 20) for n in range(60)]))
        self.assertEqual({name: each["grew"] for name, each in found.items()},
                         {"mars": True, "mars-host": True, "mars-node": False})

    def test_a_larger_process_afterwards_has_not_grown(self):
        """As where fewer nodes have as much to draw, or the film's part is another."""
        found = self.samples(*(("mars-node", [(size, 20)] * 30) for size in (20000, 40000, 80000)))
        self.assertFalse(found["mars-node"]["grew"])

    def test_a_beginning_is_no_growth(self):
        found = self.samples(("mars-node", [(1000, 9)] * BEGINNING + [(60000, 20)] * 20), ("mars", [(1000, 9)] * 9))
        self.assertEqual(found, {"mars-node": {"processes": 1, "longest": 20, "memory_kb": [60000, 60000],
                                               "descriptors": [20, 20], "grew": False}})


class Judgement(unittest.TestCase):
    SOUND = {"frames": 4, "frames_there": 4, "hash": "ab", "undisturbed_hash": "ab", "processes_left": [],
             "files_left": {}, "in_folder": ["film.mars", "frames.json"], "growth": {}, "faults": [], "given_up": "",
             "starts": [{"how": "killed", "code": 137, "ended": 3, "faults": [], "last": ""},
                        {"how": "well", "code": 0, "ended": 9, "faults": [], "last": ""}]}

    def test_sound(self):
        self.assertEqual(list(wrong(self.SOUND)), [])

    def test_what_is_wrong(self):
        fails = {"how": "failed", "code": 1, "ended": 5, "faults": [2], "last": "mars: no"}
        lines = "\n".join(wrong({**self.SOUND, "frames_there": 3, "hash": "ac", "in_folder": [".runs"],
                                 "faults": [{"number": 2, "what": "SIGKILL of mpirun", "kills": "mpirun"}],
                                 "starts": [fails]}))
        for line in ("1 frames are missing", "other pixels than undisturbed: ac", "in the film's folder: .runs",
                     "mars: no (last faults: 2 SIGKILL of mpirun)", "no mars ended well"):
            self.assertIn(line, lines)

    def test_files_of_killed_daemons(self):
        left = {**self.SOUND, "files_left": {"n1": ["/tmp/ompi.n1.0"]}}
        self.assertEqual(list(wrong(left)), ["files left on n1: /tmp/ompi.n1.0"])
        killed = [{"number": 1, "what": "SIGKILL of orted", "kills": "orted"}]
        self.assertEqual(list(wrong({**left, "faults": killed})), [])
        here = {**left, "files_left": {"this machine": ["ompi"]}, "faults": killed}
        self.assertEqual(list(wrong(here)), ["files left on this machine: ompi"])


if __name__ == "__main__":
    unittest.main()
