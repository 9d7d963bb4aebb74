"""A headless Firefox, by its own protocol, Marionette: Debian has no geckodriver."""

import json
import pathlib
import socket
import subprocess
import tempfile
import time

from settled import PATIENCE

# Letters that somebody types into a list belong to one word, however slow the machine is.
SETTINGS = {"marionette.port": 0, "ui.menu.incremental_search.timeout": 60000, "datareporting.policy.dataSubmissionEnabled": False, "app.normandy.enabled": False,
            "browser.startup.homepage_override.mstone": "ignore", "ui.systemUsesDarkTheme": 1}
KEYS = {"Enter": "\ue007", "Escape": "\ue00c", "ArrowDown": "\ue015", "ArrowRight": "\ue014", "Control": "\ue009"}


class Firefox:
    def __init__(self, program, width, height):
        self.folder = tempfile.TemporaryDirectory(prefix="mars-test-", ignore_cleanup_errors=True)
        self.profile = pathlib.Path(self.folder.name)
        lines = (f"user_pref({json.dumps(name)}, {json.dumps(value)});\n" for name, value in SETTINGS.items())
        (self.profile / "user.js").write_text("".join(lines))
        self.process = subprocess.Popen([program, "--headless", "--no-remote", "--marionette", "--profile", self.profile,
                                         f"--width={width}", f"--height={height}", "about:blank"],
                                        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self.socket = socket.create_connection(("127.0.0.1", self.port()))
        self.number = 0
        self.read()
        self.command("WebDriver:NewSession")
        self.command("WebDriver:SetTimeouts", script=2000 * PATIENCE)

    def port(self):
        file, end = self.profile / "MarionetteActivePort", time.monotonic() + PATIENCE
        while not (file.exists() and file.read_text()):
            if time.monotonic() > end or self.process.poll() is not None:
                raise RuntimeError("Firefox does not start")
            time.sleep(0.02)
        return int(file.read_text())

    def quit(self):
        self.socket.close()
        self.process.terminate()
        self.process.wait(PATIENCE)
        self.folder.cleanup()

    # Messages: a length, a colon, and as many bytes of JSON.

    def read(self):
        length = b""
        while not length.endswith(b":"):
            length += self.socket.recv(1)
        data, size = b"", int(length[:-1])
        while len(data) < size:
            data += self.socket.recv(size - len(data))
        return json.loads(data)

    def command(self, name, **parameters):
        self.number += 1
        message = json.dumps([0, self.number, name, parameters]).encode()
        self.socket.sendall(str(len(message)).encode() + b":" + message)
        _, _, error, result = self.read()
        if error:
            raise RuntimeError(f"{name}: {error['error']}: {error['message']}")
        return result

    # What a person does.

    def open(self, link):
        self.command("WebDriver:Navigate", url=link)

    def js(self, text, *arguments):
        """A function's body; what it returns, also by a promise."""
        script = f"const done = [...arguments].at(-1); (async () => {{ {text} }})().then((it) => done([it ?? null]), (error) => done(`${{error}}`));"
        result = self.command("WebDriver:ExecuteAsyncScript", script=script, args=arguments, sandbox=None)["value"]
        if isinstance(result, str):
            raise RuntimeError(result)
        return result[0]

    def perform(self, kind, *actions):
        source = {"type": kind, "id": kind, "actions": actions}
        self.command("WebDriver:PerformActions", actions=[source | ({"parameters": {"pointerType": "mouse"}} if kind == "pointer" else {})])

    def drag(self, begin, end, steps=5, button=0):
        ways = [[round(a + (b - a) * step / steps) for a, b in zip(begin, end)] for step in range(steps + 1)]
        moves = [{"type": "pointerMove", "x": x, "y": y} for x, y in ways]
        self.perform("pointer", moves[0], {"type": "pointerDown", "button": button}, *moves[1:], {"type": "pointerUp", "button": button})

    def click(self, spot):
        self.drag(spot, spot, steps=1)

    def wheel(self, spot, down):
        self.perform("wheel", {"type": "scroll", "x": round(spot[0]), "y": round(spot[1]), "deltaX": 0, "deltaY": down})

    def press(self, *keys):
        """One after the other; "Control+a" together."""
        for key in keys:
            held = [KEYS.get(each, each) for each in (key.split("+") if len(key) > 1 else [key])]
            self.perform("key", *({"type": "keyDown", "value": each} for each in held),
                         *({"type": "keyUp", "value": each} for each in reversed(held)))
