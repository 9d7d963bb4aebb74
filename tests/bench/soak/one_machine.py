"""This machine alone, without root: what works in a folder of ours is ours, beside all others' processes."""
import os
import pathlib

from cluster import Machines, Process, state_and_program

HERE = "this machine"


class OneMachine(Machines):
    """`folder`: what runs has it as its working folder, and its temporary files in `tmp` there."""

    def __init__(self, folder, environment):
        self.folder = folder
        self.temporary = folder / "tmp"
        self.environment = {**environment, "TMPDIR": str(self.temporary)}

    def __enter__(self):
        self.temporary.mkdir()
        return self

    def __exit__(self, *_):
        self.end_what_is_left()

    def on(self, _, *words):
        return [str(word) for word in words]

    def processes(self, *programs, host=None):
        """Living processes of `programs` or, without any, of all programs."""
        found = []
        for number in map(int, filter(str.isdigit, os.listdir("/proc"))):
            seen = self.works_here(number) and state_and_program(number)
            if seen and seen[0] not in "ZX" and (not programs or seen[1] in programs):
                found.append(Process(number, seen[1], HERE))
        return found

    def works_here(self, number):
        try:
            return os.readlink(f"/proc/{number}/cwd") == str(self.folder)
        except OSError:
            return False

    def left(self):
        return self.processes()

    def own_files(self):
        return {HERE: sorted(str(path) for path in pathlib.Path(self.temporary).rglob("*"))}
