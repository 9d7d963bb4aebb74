"""Render farms: what the files of cluster/farms have Deadline, OpenCue and Flamenco run, with stand-ins for the farms."""

import json
import re
import shlex
import signal
import subprocess
import sys
import types

from harness import (ENVIRONMENT, PROGRAMS, SECONDS, SOURCES, ProgramTest, endless_film, family, main, needs,
                     spinning_teapot, stopped, wait_until)

FARMS = SOURCES / "cluster/farms"
FRAMES, CHUNK = 6, 4
# Like a JavaScript engine of Flamenco: what job types call, and the tasks as JSON.
FLAMENCO = """
const tasks = [];
globalThis.author = {Task: (name) => ({name, commands: [], after: [], addCommand(command) { this.commands.push(command); },
                                       addDependency(task) { this.after.push(task.name); }}),
                     Command: (name, parameters) => ({name, parameters})};
globalThis.frameChunker = (frames, size) => {
  const [first, last] = frames.split("-").map(Number), chunks = [];
  for (let at = first; at <= last; at += size) chunks.push(`${at}-${Math.min(at + size - 1, last)}`);
  return chunks;
};
(0, eval)(require("fs").readFileSync(process.argv[1], "utf8").replace("const JOB_TYPE", "var JOB_TYPE"));
compileJob({settings: JSON.parse(process.argv[2]), addTask: (task) => tasks.push(task)});
console.log(JSON.stringify({type: JOB_TYPE, tasks}));
"""


def pairs(path):
    """The keys of a Deadline file."""
    lines = [line for line in path.read_text().splitlines() if line and not line.startswith("#")]
    return dict(line.split("=", 1) for line in lines)


def chunks(first, last, size):
    return [(at, min(at + size - 1, last)) for at in range(first, last + 1, size)]


class Farms(ProgramTest):
    def setUp(self):
        super().setUp()
        self.film = self.write("film.json", spinning_teapot(FRAMES, [64, 48]))
        self.frames = self.folder / "frames"

    def start(self, words):
        self.assertEqual(words[0], "mars")
        words = [PROGRAMS / "mars", *words[1:], "--backend", "threads", "--nodes", "1"]
        return subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=ENVIRONMENT)

    def ends(self, task, code=0):
        out, error = task.communicate(timeout=SECONDS)
        self.assertEqual(task.returncode, code, out + error)
        return out, error

    def run_all_at_once(self, commands, last):
        """The last command alone, after all others."""
        self.assertGreater(len(commands), 1)
        for task in [self.start(words) for words in commands]:
            self.ends(task)
        self.assertEqual(last[:2], ["mars", "verify"])
        self.assertIn(f"{FRAMES} frames", self.succeed(*last))

    def moved(self, text):
        return text.replace("/films/film.json", str(self.film)).replace("/films/frames", str(self.frames))

    def test_deadline(self):
        job, plugin = pairs(FARMS / "deadline.job"), pairs(FARMS / "deadline.plugin")
        self.assertEqual((job["Plugin"], plugin["Executable"]), ("CommandLine", "mars"))
        self.assertRegex(job["Frames"], r"^\d+-\d+$")
        self.assertGreater(int(job["ChunkSize"]), 1)
        with_frames = lambda first, last: plugin["Arguments"].replace("<STARTFRAME>", str(first)).replace(
            "<ENDFRAME>", str(last))
        last, verifies = pairs(FARMS / "deadline-verify.job"), pairs(FARMS / "deadline-verify.plugin")
        self.assertEqual((last["Plugin"], verifies["Executable"]), ("CommandLine", "mars"))
        self.assertIn("JobDependencies", last)
        self.run_all_at_once([["mars", *shlex.split(self.moved(with_frames(*chunk)))]
                              for chunk in chunks(0, FRAMES - 1, CHUNK)],
                             ["mars", *shlex.split(self.moved(verifies["Arguments"]))])

    def test_opencue(self):
        layers = []
        outline, shell = types.ModuleType("outline"), types.ModuleType("outline.modules.shell")
        outline.Outline = lambda name: types.SimpleNamespace(name=name, add_layer=layers.append)
        outline.cuerun = types.SimpleNamespace(launch=lambda job, use_pycuerun: None)
        after = []
        shell.Shell = lambda name, **options: types.SimpleNamespace(name=name, depend_all=after.append, **options)
        for name, module in (("outline", outline), ("outline.modules", types.ModuleType("outline.modules")),
                             ("outline.modules.shell", shell)):
            sys.modules[name] = module
        script = {"__name__": "opencue"}
        exec((FARMS / "opencue.py").read_text(), script)
        script["main"](str(self.film), str(self.frames), f"0-{FRAMES - 1}", str(CHUNK))
        layer, verify = layers
        self.assertEqual(after, [layer])
        self.assertEqual((layer.range, layer.chunk), (f"0-{FRAMES - 1}", CHUNK))
        self.run_all_at_once([[word.replace("#FRAMESPEC#", frames) for word in layer.command]
                              for frames in (f"0-{FRAMES - 1}x2", f"1-{FRAMES - 3}x2", f"{FRAMES - 1}")],
                             verify.command)

    def test_opencue_without_arguments_says_its_use(self):
        for words in [[], ["film.json", "frames"], ["film.json", "frames", "0-9", "many"]]:
            done = subprocess.run([sys.executable, FARMS / "opencue.py", *words], stderr=subprocess.PIPE, text=True)
            self.assertEqual(done.returncode, 1)
            self.assertIn("opencue.py FILM DIR FRAMES [CHUNK]", done.stderr)
            self.assertNotIn("Traceback", done.stderr)

    @needs("node")
    def test_flamenco(self):
        settings = {"film": str(self.film), "folder": str(self.frames), "frames": f"0-{FRAMES - 1}", "chunk_size": CHUNK}
        job = json.loads(subprocess.run(["node", "-e", FLAMENCO, FARMS / "mars-render.js", json.dumps(settings)],
                                        check=True, stdout=subprocess.PIPE, text=True).stdout)
        self.assertEqual({setting["key"] for setting in job["type"]["settings"]}, set(settings))
        *parts, last = job["tasks"]
        self.assertEqual(last["after"], [task["name"] for task in parts])
        commands = [command for task in job["tasks"] for command in task["commands"]]
        self.assertEqual({command["name"] for command in commands}, {"exec"})
        words = [[command["parameters"]["exe"], *command["parameters"]["args"]] for command in commands]
        self.run_all_at_once(words[:-1], words[-1])

    def test_a_stopped_chunk_goes_on_and_says_how_far_it_is(self):
        film = self.write("long.json", endless_film())
        words = ["mars", "render", str(film), "-o", str(self.frames), "--restarts", "0", "--frames"]
        task = self.start([*words, "0-"])
        self.addCleanup(self.end, task)
        wait_until(lambda: len(list(self.frames.glob("frame-*.png"))) > 3, SECONDS, "no frame")
        with stopped(family(task.pid)):
            while not (match := re.match(r"Progress: (\d+)%, ", task.stdout.readline())):
                self.assertIsNone(task.poll())
        self.assertLess(int(match[1]), 100)
        task.send_signal(signal.SIGTERM)
        self.ends(task, 1)
        there = len(list(self.frames.glob("frame-*.png")))
        self.assertGreater(there, 2)
        out, _ = self.ends(self.start([*words, "0-1"]))
        self.assertIn("nothing is left to render", out)

    def test_what_fails_says_why(self):
        words = ["mars", "render", str(self.film), "-o", str(self.frames), "--restarts", "0"]
        _, error = self.ends(self.start([*words, "--frames", f"{FRAMES}-{FRAMES + 3}"]), 1)
        self.assertClear(error, "beyond the film's last")
        _, error = self.ends(self.start([*words, "--frames", "<STARTFRAME>-"]), 2)
        self.assertIn("is not a frame or a range of frames", error)


if __name__ == "__main__":
    main()
