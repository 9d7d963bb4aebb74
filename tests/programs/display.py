"""A display without a screen, for tests of windows: Xvfb, whose pixels are read from its memory, and keys that are pressed
in its windows. `Relay` counts what a program sends a display at the other end of a network."""

import ctypes
import mmap
import os
import pathlib
import random
import select
import signal
import socket
import struct
import subprocess
import threading
import time

from harness import SECONDS, wait_until

SPECIAL = {"Escape": 0xff1b, "Left": 0xff51, "Right": 0xff53, "Home": 0xff50, "End": 0xff57}
KEY_PRESS, KEY_RELEASE = 2, 3
SOCKET, LOCK = "/tmp/.X11-unix/X{}", "/tmp/.X{}-lock"  # of a display's number
IGNORED = ctypes.CFUNCTYPE(ctypes.c_int, ctypes.c_void_p, ctypes.c_void_p)(lambda display, error: 0)


class KeyEvent(ctypes.Structure):
    _fields_ = [("type", ctypes.c_int), ("serial", ctypes.c_ulong), ("sent", ctypes.c_int), ("display", ctypes.c_void_p),
                ("window", ctypes.c_ulong), ("root", ctypes.c_ulong), ("child", ctypes.c_ulong), ("time", ctypes.c_ulong),
                ("x", ctypes.c_int), ("y", ctypes.c_int), ("x_root", ctypes.c_int), ("y_root", ctypes.c_int),
                ("state", ctypes.c_uint), ("code", ctypes.c_uint), ("same_screen", ctypes.c_int),
                ("rest", ctypes.c_long * 24)]


def x11():
    library = ctypes.CDLL("libX11.so.6")
    library.XOpenDisplay.restype = ctypes.c_void_p
    library.XDefaultRootWindow.restype = ctypes.c_ulong
    for name in ["XDefaultRootWindow", "XFlush", "XSync", "XCloseDisplay", "XFetchName", "XQueryTree", "XKeysymToKeycode",
                 "XSendEvent", "XFree"]:
        getattr(library, name).argtypes = [ctypes.c_void_p]
    library.XFetchName.argtypes = [ctypes.c_void_p, ctypes.c_ulong, ctypes.POINTER(ctypes.c_char_p)]
    library.XQueryTree.argtypes = [ctypes.c_void_p, ctypes.c_ulong, *[ctypes.c_void_p] * 4]
    library.XKeysymToKeycode.argtypes = [ctypes.c_void_p, ctypes.c_ulong]
    library.XKeysymToKeycode.restype = ctypes.c_ubyte
    library.XSendEvent.argtypes = [ctypes.c_void_p, ctypes.c_ulong, ctypes.c_int, ctypes.c_long, ctypes.c_void_p]
    library.XSync.argtypes = [ctypes.c_void_p, ctypes.c_int]
    return library


class Display:
    """Its number is none of 0 to 9: programs over MPI, also those of other tests, ask those displays what cards they have,
    and would end or stand still with them."""

    def __init__(self, folder, *options, width=800, height=600):
        words = ["-screen", "0", f"{width}x{height}x24", "-fbdir", str(folder), "-ac", "-noreset", "-nolisten", "tcp",
                 *options]
        numbers = random.sample(range(10, 1000), 20)
        self.number = next((number for number in numbers if self.is_started(number, words)), None)
        assert self.number is not None, f"Xvfb starts at none of the displays {numbers}"
        self.name = f":{self.number}"
        with open(pathlib.Path(folder) / "Xvfb_screen0", "rb") as file:
            self.memory = mmap.mmap(file.fileno(), 0, prot=mmap.PROT_READ)
        header = struct.unpack(">25I", self.memory[:100])
        self.at, self.height, self.stride = header[0] + 12 * header[19], header[5], header[12]
        self.library = x11()
        self.library.XSetErrorHandler(IGNORED)  # Xlib's own ends the program where a window has just gone
        self.client = self.library.XOpenDisplay(self.name.encode())

    def is_started(self, number, words):
        """No, if another server has the number."""
        reading, writing = os.pipe()
        self.server = subprocess.Popen(["Xvfb", f":{number}", "-displayfd", str(writing), *words], pass_fds=[writing],
                                       stderr=subprocess.DEVNULL, stdout=subprocess.DEVNULL)
        os.close(writing)
        with open(reading) as said:
            started = said.readline() != ""
        if not started:
            self.server.wait()
        return started

    def end(self):
        """The server, which may stand still, removes its socket and its lock, unless a test has killed the server."""
        if self.server.returncode is not None:
            return  # it has been ended before, and its number may be another's
        self.server.terminate()
        self.server.send_signal(signal.SIGCONT)
        if self.server.wait() == -signal.SIGKILL:
            for file in [SOCKET, LOCK]:
                pathlib.Path(file.format(self.number)).unlink(missing_ok=True)

    def rows(self):
        """Of the screen: red, green, blue a pixel."""
        rows = []
        for y in range(self.height):
            row = self.memory[self.at + y * self.stride:self.at + (y + 1) * self.stride]
            colors = bytearray(3 * (self.stride // 4))
            colors[0::3], colors[1::3], colors[2::3] = row[2::4], row[1::4], row[0::4]
            rows.append(bytes(colors))
        return rows

    def shows(self, picture):
        """Whether these rows are somewhere on the screen."""
        screen = self.rows()
        for y in range(len(screen) - len(picture) + 1):
            x = screen[y].find(picture[0])
            while x >= 0:
                if x % 3 == 0 and all(screen[y + i][x:x + len(row)] == row for i, row in enumerate(picture)):
                    return True
                x = screen[y].find(picture[0], x + 1)
        return False

    def windows(self):
        """The titles of windows by their number."""
        self.library.XSync(self.client, 0)
        unused, children, count = ctypes.c_ulong(), ctypes.POINTER(ctypes.c_ulong)(), ctypes.c_uint()
        self.library.XQueryTree(self.client, self.library.XDefaultRootWindow(self.client), ctypes.byref(unused),
                                ctypes.byref(unused), ctypes.byref(children), ctypes.byref(count))
        titles = {}
        for window in children[:count.value]:
            name = ctypes.c_char_p()
            if self.library.XFetchName(self.client, window, ctypes.byref(name)) and name.value:
                titles[window] = name.value.decode()
        return titles

    def press(self, key):
        """In the only window that has a title: a character, or a key of SPECIAL."""
        (window,) = self.windows()
        code = self.library.XKeysymToKeycode(self.client, SPECIAL.get(key) or ord(key))
        for kind in [KEY_PRESS, KEY_RELEASE]:
            event = KeyEvent(type=kind, sent=1, window=window, root=self.library.XDefaultRootWindow(self.client),
                             time=int(time.monotonic() * 1000) & 0xffffffff, state=0, code=code, same_screen=1)
            self.library.XSendEvent(self.client, window, 1, 1 if kind == KEY_PRESS else 2, ctypes.byref(event))
        self.library.XSync(self.client, 0)


class Relay:
    """Another name of a display, which makes no use of shared memory. Counts the bytes that go to the display."""

    def __init__(self, display):
        self.listener = socket.create_server(("127.0.0.1", 0))
        self.name = f"127.0.0.1:{self.listener.getsockname()[1] - 6000}"
        self.display, self.bytes, self.ended = display, 0, False
        self.thread = threading.Thread(target=self.work, daemon=True)
        self.thread.start()

    def work(self):
        ends = {}
        while not self.ended:
            for ready in select.select([self.listener, *ends], [], [], 0.1)[0]:
                if ready is self.listener:
                    client, server = self.listener.accept()[0], socket.socket(socket.AF_UNIX)
                    server.connect(SOCKET.format(self.display.number))
                    ends[client], ends[server] = (server, True), (client, False)
                    continue
                if ready not in ends:
                    continue
                to, counted = ends[ready]
                data = ready.recv(1 << 20)
                self.bytes += len(data) if counted else 0
                if data:
                    to.sendall(data)
                else:
                    del ends[ready], ends[to]
                    ready.close(), to.close()

    def settled(self):
        """Its count, once it has not grown for a while."""
        before = -1
        while before != self.bytes:
            before = self.bytes
            time.sleep(0.1)
        return before

    def end(self):
        self.ended = True
        self.thread.join()
        self.listener.close()


def wait_for_picture(display, picture):
    wait_until(lambda: display.shows(picture), SECONDS, "the window does not show the picture")
