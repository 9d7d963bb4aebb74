"""Runs the tests that ctest knows of a build as a mutant: two at a time, each in an environment that has the mutant's
number, each with a limit of time, and until nothing that a test started is left."""

import json
import os
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import time

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "costs"))
import costs  # noqa: E402

PROCESSORS = 2
JUDGES = {"quick": set(costs.QUICK) - {"rule"}, "all": set(costs.LATER)}


class Test:
    def __init__(self, described):
        self.name, self.command = described["name"], described["command"]
        self.properties = {each["name"]: each["value"] for each in described.get("properties", [])}
        self.limit = self.properties.get("TIMEOUT", 1500)
        self.processors = min(int(self.properties.get("PROCESSORS", 1)), PROCESSORS)
        self.labels = set(self.properties.get("LABELS", []))

    def tier(self):
        """Nothing for tests that compare the sources themselves, and for those on a virtual cluster, whose machines do
        not get the environment."""
        return next((tier for tier, labels in JUDGES.items() if self.labels & labels), None)

    def nearness(self, file):
        """How far down a file's path the test's name leads: studio_stage_test far to host/studio/stage/hand.cpp."""
        words = [word for word in re.split("[_ ]", self.name.removesuffix("_test")) if len(word) > 2]
        parts = pathlib.PurePath(file).with_suffix("").parts
        return sum(i for i, part in enumerate(parts, 1) if any(part.startswith(word) for word in words))


def tests_of(build):
    said = subprocess.check_output(["ctest", "--test-dir", build, "--show-only=json-v1"])
    return [Test(each) for each in json.loads(said)["tests"] if "command" in each]


class Run:
    """A test that runs. What the test leaves is found by RUN_OF_MUTANT in its environment, which nothing else sets."""

    def __init__(self, test, number, limit, log):
        self.test, self.limit, self.log = test, limit, log
        self.folder = tempfile.TemporaryDirectory(prefix="m-", ignore_cleanup_errors=True)
        environment = {**os.environ, "TMPDIR": self.folder.name}
        environment |= dict(line.split("=", 1) for line in test.properties.get("ENVIRONMENT", []))
        environment |= {"MUTANT_OF_MARS": str(number), "RUN_OF_MUTANT": self.folder.name}
        log.parent.mkdir(parents=True, exist_ok=True)
        self.begin = time.monotonic()
        with log.open("wb") as output:
            self.process = subprocess.Popen(
                test.command, cwd=test.properties["WORKING_DIRECTORY"], env=environment, stdin=subprocess.DEVNULL,
                stdout=output, stderr=output, start_new_session=True)

    def outcome(self):
        """Nothing while it runs."""
        code = self.process.poll()
        if code is None:
            return "time-out" if time.monotonic() > self.begin + self.limit else None
        skips = self.test.properties.get("SKIP_REGULAR_EXPRESSION", [])
        said = self.log.read_text(errors="replace") if skips else ""
        if code == self.test.properties.get("SKIP_RETURN_CODE") or any(re.search(text, said) for text in skips):
            return "skipped"
        return "passed" if code == 0 else "failed" if code > 0 else signal.Signals(-code).name

    def end(self):
        mark = f"RUN_OF_MUTANT={self.folder.name}".encode()
        for environment in pathlib.Path("/proc").glob("[0-9]*/environ"):
            try:
                if mark in environment.read_bytes().split(b"\0"):
                    os.kill(int(environment.parent.name), signal.SIGKILL)
            except OSError:
                pass  # Others' processes, and those that have ended.
        self.process.kill()
        self.process.wait()
        self.folder.cleanup()


def outcomes(tests, number, limit_of, logs):
    """Each test as it ends, how it ended, and after how many seconds. If no more is wanted, the rest ends, too."""
    waiting, running = list(tests), []
    try:
        while waiting or running:
            while waiting and sum(run.test.processors for run in running) + waiting[0].processors <= PROCESSORS:
                test = waiting.pop(0)
                running.append(Run(test, number, limit_of(test), logs / f"{test.name}.txt"))
            time.sleep(0.02)
            for run in list(running):
                if outcome := run.outcome():
                    running.remove(run)
                    seconds = time.monotonic() - run.begin
                    run.end()
                    yield run.test, outcome, seconds
    finally:
        for run in running:
            run.end()
