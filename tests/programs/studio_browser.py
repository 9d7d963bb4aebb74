"""`mars studio`, and a headless Chromium for its page."""

import errno
import os
import pathlib
import re
import shutil
import signal
import socket
import subprocess
import sys
import threading
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "host/studio/page"))
from chromium import Chromium  # noqa: E402
from settled import PATIENCE, SCRIPT  # noqa: E402

CTRL, SHIFT = 2, 8


class Studio:
    """`mars studio FILE` in the file's folder; in a folder, one that begins a new model. `link` as a person gets it. Its
    port, unless one is given, is any free one: at the usual port, pages of other tests might look for their studios."""

    def __init__(self, programs, file, *arguments, port=0):
        file = pathlib.Path(file)
        opened, folder = ([], file) if file.is_dir() else ([file.name], file.parent)
        command = [pathlib.Path(programs) / "mars", "studio", *opened, "--no-browser", "--port", str(port), *arguments]
        self.process = subprocess.Popen(command, cwd=folder, text=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        self.link = None
        for line in self.process.stdout:
            if line.startswith("Open "):
                self.link = line.split()[1]
            if line.startswith("Ctrl-C"):
                break
        if self.link is None:
            raise RuntimeError(f"mars studio: {self.process.communicate()[1]}")

    def end(self, number=signal.SIGTERM):
        """The exit code and what it complained of."""
        if self.process.poll() is None:
            self.process.send_signal(number)
        errors = self.process.communicate(timeout=PATIENCE)[1]
        return self.process.returncode, errors

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.end(signal.SIGTERM)


def found(program):
    """The program's file; an error as starting it would give where it is not installed."""
    if file := shutil.which(program):
        return file
    raise FileNotFoundError(errno.ENOENT, "not installed", program)


class Browser(Chromium):
    """`script` runs before the page's own ones, after SETTLED."""

    SETTLED = SCRIPT

    def __init__(self, width=1280, height=720, script="", flags=(), patience=PATIENCE):
        super().__init__(found("chromedriver"), width, height, flags, patience)
        self.command("Page.addScriptToEvaluateOnNewDocument", source=self.SETTLED + script)
        self.logged = []

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.driver.quit()

    def open(self, link):
        self.driver.get(link)

    def until(self, what, condition):
        """`condition`: JavaScript, or a function; its first value that counts as true."""
        last = time.monotonic() + self.patience
        while not (value := self.run(f"return {condition}") if isinstance(condition, str) else condition()):
            if time.monotonic() > last:
                raise AssertionError(f"not within {self.patience} s: {what}\n" + "\n".join(self.console()))
            time.sleep(0.02)
        return value

    def console(self):
        """All warnings and errors until now."""
        self.logged += [f"{entry['level']} {entry['message']}" for entry in self.driver.get_log("browser")
                        if entry["level"] in ("WARNING", "SEVERE")]
        return self.logged

    def key(self, name, shown="", modifiers=0):
        for kind in ("keyDown", "keyUp"):
            self.command("Input.dispatchKeyEvent", type=kind, key=name, text=shown if kind == "keyDown" else "",
                         modifiers=modifiers, windowsVirtualKeyCode=ord(name.upper()) if len(name) == 1 else 0)

    def find(self, view, wanted):
        """A place of a view's picture at which the mouse finds something whose text has `wanted` in it. What a busy
        studio says too late is found the next time."""
        last = time.monotonic() + self.patience
        while not (found := self.find_once(view, wanted)):
            if time.monotonic() > last:
                raise AssertionError(f"nothing there has '{wanted}'")
        return found

    def find_once(self, view, wanted):
        left, top, width, height = self.run("""
            const at = arguments[0].getBoundingClientRect();
            return [at.x, at.y, at.width, at.height];""", view)
        for columns in (40, 120):  # some limbs are small
            for down in (0.5, 0.45, 0.4, 0.55, 0.35, 0.6, 0.3, 0.65, 0.25, 0.7, 0.2, 0.75):
                for along in [0.5 + sign * step / columns for step in range(2 * columns // 5) for sign in (1, -1)]:
                    x, y = round(left + along * width), round(top + down * height)
                    self.move(x, y)
                    self.settle()
                    over, text = self.run("""
                        const [view] = arguments;
                        return [view.dataset.over, view.querySelector('.tip').textContent];""", view)
                    if over == "limb" and wanted in text:
                        return x, y
        return None

    def screenshot(self, path):
        self.driver.save_screenshot(str(path))


class Proxy:
    """A network between page and studio that can be cut and mended."""

    def __init__(self, link):
        self.target, self.ends = int(re.search(r":(\d+)/", link)[1]), []
        self.open()
        self.link = link.replace(f":{self.target}/", f":{self.port}/")

    def open(self, port=0):
        self.listener = socket.create_server(("127.0.0.1", port))
        self.port = self.listener.getsockname()[1]
        threading.Thread(target=self.accept, args=(self.listener,), daemon=True).start()

    def accept(self, listener):
        while True:
            try:
                page = listener.accept()[0]
                studio = socket.create_connection(("127.0.0.1", self.target))
            except OSError:
                return
            self.ends += [page, studio]
            for one, other in ((page, studio), (studio, page)):
                threading.Thread(target=self.carry, args=(one, other), daemon=True).start()

    def carry(self, one, other):
        try:
            while data := one.recv(1 << 16):
                other.sendall(data)
        except OSError:
            pass
        self.end(one, other)

    @staticmethod
    def end(*ends):
        for each in ends:
            try:
                each.shutdown(socket.SHUT_RDWR)
            except OSError:
                pass

    def cut(self):
        self.end(self.listener, *self.ends)
        for each in [self.listener, *self.ends]:
            each.close()
        self.ends = []


def tree_of(ancestor):
    """Processes of a process's family, itself among them, with their command lines."""
    parents = {}
    for entry in os.listdir("/proc"):
        if entry.isdigit():
            try:
                stat = pathlib.Path(f"/proc/{entry}/stat").read_text().rpartition(")")[2].split()
                parents[int(entry)] = int(stat[1])
            except OSError:
                pass
    found, grown = {ancestor}, True
    while grown:
        more = {process for process, parent in parents.items() if parent in found} - found
        grown = bool(more)
        found |= more
    lines = {}
    for process in found:
        try:
            lines[process] = pathlib.Path(f"/proc/{process}/cmdline").read_bytes().decode(errors="replace").split("\0")
        except OSError:
            pass
    return lines
