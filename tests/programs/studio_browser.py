"""`mars studio` and a headless Chromium whose mouse and keyboard are moved by the DevTools protocol, as a person's
are."""

import errno
import os
import pathlib
import re
import shutil
import signal
import socket
import subprocess
import threading
import time

from selenium import webdriver
from selenium.webdriver.chrome.options import Options
from selenium.webdriver.chrome.service import Service

SECONDS = 30  # for whatever the page must show
# Without a graphics card, Chromium's own raster is quicker than a card that the processor imitates.
FLAGS = ["--headless=new", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run",
         "--disable-background-networking", "--disable-component-update", "--disable-sync", "--disable-extensions"]
BUTTONS = {"left": 1, "right": 2, "middle": 4}
CTRL, SHIFT = 2, 8
# Rows of the tree that are out of sight are no elements.
SHOW_IN_TREE = """
const tree = document.querySelector("#tree [role=tree]");
for (let top = 0; !document.querySelector(arguments[0]) && top < tree.scrollHeight; top += tree.clientHeight / 2) {
  tree.scrollTop = top;
  tree.dispatchEvent(new Event("scroll"));
}
"""


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
        errors = self.process.communicate(timeout=SECONDS)[1]
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


class Browser:
    def __init__(self, width=1280, height=720, script=None, flags=()):
        options = Options()
        for flag in [*FLAGS, *flags]:
            options.add_argument(flag)
        options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
        self.driver = webdriver.Chrome(options=options, service=Service(found("chromedriver")))
        self.command("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1,
                     mobile=False)
        if script:
            self.command("Page.addScriptToEvaluateOnNewDocument", source=script)
        self.held = ""
        self.logged = []

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.driver.quit()

    def command(self, name, **arguments):
        return self.driver.execute_cdp_cmd(name, arguments)

    def open(self, link):
        self.driver.get(link)

    def run(self, script, *arguments):
        return self.driver.execute_script(script, *arguments)

    def until(self, what, condition, seconds=None):
        """`condition`: JavaScript, or a function; its first value that counts as true."""
        last = time.monotonic() + (seconds or SECONDS)
        while not (value := self.run(f"return {condition}") if isinstance(condition, str) else condition()):
            if time.monotonic() > last:
                raise AssertionError(f"not within {seconds or SECONDS} s: {what}\n" + "\n".join(self.console()))
            time.sleep(0.02)
        return value

    def console(self):
        """All warnings and errors until now."""
        self.logged += [f"{entry['level']} {entry['message']}" for entry in self.driver.get_log("browser")
                        if entry["level"] in ("WARNING", "SEVERE")]
        return self.logged

    # ---- mouse and keys

    def mouse(self, kind, x, y, button="none", clicks=0, keys=0):
        held = BUTTONS.get(self.held, 0)
        self.command("Input.dispatchMouseEvent", type=kind, x=x, y=y, button=button, buttons=held, clickCount=clicks,
                     modifiers=keys)

    def move(self, x, y, keys=0):
        self.mouse("mouseMoved", x, y, self.held or "none", keys=keys)

    def press(self, x, y, button="left", clicks=1, keys=0):
        self.held = button
        self.mouse("mousePressed", x, y, button, clicks, keys)

    def release(self, x, y, clicks=1, keys=0):
        button, self.held = self.held, ""
        self.mouse("mouseReleased", x, y, button, clicks, keys)

    def click(self, x, y, clicks=1, keys=0):
        self.move(x, y, keys)
        for each in range(1, clicks + 1):
            self.press(x, y, clicks=each, keys=keys)
            self.release(x, y, clicks=each, keys=keys)

    def drag(self, begin, end, steps=10, button="left", keys=0):
        self.move(*begin)
        self.press(*begin, button, keys=keys)
        for step in range(1, steps + 1):
            self.move(*(a + (b - a) * step / steps for a, b in zip(begin, end)), keys=keys)
        self.release(*end, keys=keys)

    def center(self, selector):
        return self.run("""
            const at = document.querySelector(arguments[0]).getBoundingClientRect();
            return [at.x + at.width / 2, at.y + at.height / 2];""", selector)

    def find(self, view, wanted, pause=0.03):
        """A place of a view's picture at which the mouse finds something whose text has `wanted` in it. `pause`:
        seconds until the studio has said what is there."""
        left, top, width, height = self.run("""
            const at = arguments[0].getBoundingClientRect();
            return [at.x, at.y, at.width, at.height];""", view)
        # A busy machine answers late, and some limbs are small.
        for patience, columns in ((pause, 40), (2 * pause, 120), (5 * pause, 40)):
            for down in (0.5, 0.45, 0.4, 0.55, 0.35, 0.6, 0.3, 0.65, 0.25, 0.7, 0.2, 0.75):
                for along in [0.5 + sign * step / columns for step in range(2 * columns // 5) for sign in (1, -1)]:
                    x, y = round(left + along * width), round(top + down * height)
                    self.move(x, y)
                    time.sleep(patience)
                    over, text = self.run("""
                        const [view] = arguments;
                        return [view.dataset.over, view.querySelector('.tip').textContent];""", view)
                    if over == "limb" and wanted in text:
                        return x, y
        raise AssertionError(f"nothing there has '{wanted}'")

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
