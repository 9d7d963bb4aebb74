"""Renderings that are killed at random moments and then finished: folders and videos are those of a rendering that nothing
disturbed, and nothing else is left."""
import pathlib
import shutil
import signal
import subprocess
import time

from watcher import Watcher

MOST_KILLS = 2   # of one rendering
LONGEST = 1.0    # seconds that a rendering lives before it is killed
PATIENCE = 120   # seconds for a process to die of a signal, and for what the process has started to end after that
ENDINGS = [signal.SIGKILL, signal.SIGTERM]


def lives_with(word):
    """Whether the command line of a process that has not ended has the word."""
    for process in pathlib.Path("/proc").glob("[0-9]*"):
        try:
            if word in (process / "cmdline").read_text(errors="replace").split("\0"):
                return True
        except OSError:  # the process has ended since
            continue
    return False


class Killed:
    """`films` is an identity.Films, and `path` the film's file in its folder."""

    def __init__(self, films, path, choose, backends):
        self.films, self.path, self.choose = films, path, choose
        self.how = {"--backend": choose.choice(backends), "--nodes": str(choose.randint(2, 4))}
        self.kills = 0

    def begin_and_kill(self, words):
        process = subprocess.Popen([self.films.mars, *words], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        try:
            process.wait(self.choose.uniform(0, LONGEST))
        except subprocess.TimeoutExpired:
            self.kills += 1
            process.send_signal(self.choose.choice(ENDINGS))
            process.wait(PATIENCE)
        self.wait_for_what_was_started()

    def wait_for_what_was_started(self):
        """A host outlives its mpirun for a moment, in which the folder is the host's."""
        until = time.monotonic() + PATIENCE
        while lives_with(str(self.path)):
            if time.monotonic() > until:
                raise RuntimeError(f"processes that draw {self.path} live {PATIENCE} s after their command was killed")
            time.sleep(0.05)

    def render(self, words, watcher_of=lambda: None):
        """The watcher of the last start, which runs to its end."""
        for _ in range(self.choose.randint(1, MOST_KILLS)):
            watcher_of()
            self.begin_and_kill(words)
        watcher = watcher_of()
        self.films.run(words)
        return watcher

    def empty_folder(self, name):
        folder = self.films.folder / name
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir()
        return folder

    def frames_differ(self, pixels):
        """`pixels`: the hash of an undisturbed folder's."""
        place = str(self.films.folder / "watcher")
        self.empty_folder("killed")
        words = self.films.words(self.path, self.how | {"--watch": place}, "killed")
        watcher = self.render(words, lambda: Watcher(place))
        if not watcher.has_waited_in_vain():
            self.films.check_watcher(watcher, self.path, "killed")
        return self.films.pixels("killed") != pixels

    def videos_differ(self):
        words = ["--quiet", *(word for option in self.how.items() for word in option)]
        alone, killed = (self.empty_folder(name) / "film.mp4" for name in ("alone", "killed"))
        self.films.run(["render", str(self.path), "-o", str(alone), *words])
        self.render(["render", str(self.path), "-o", str(killed), *words])
        left = [file.name for file in killed.parent.iterdir()]
        if left != [killed.name]:
            raise RuntimeError(f"{killed.parent} has {' '.join(sorted(left))}")
        return alone.read_bytes() != killed.read_bytes()
