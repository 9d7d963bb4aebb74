"""A headless Chromium whose mouse and keyboard are moved by the DevTools protocol, as a person's are. Whoever acts on the
studio's page acts on a settled one (settled.js)."""

import contextlib

from selenium import webdriver
from selenium.webdriver.chrome.service import Service

from settled import PATIENCE

# Without a graphics card, Chromium's own raster is quicker than a card that the processor imitates.
FLAGS = ["--headless=new", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run",
         "--disable-background-networking", "--disable-component-update", "--disable-sync", "--disable-extensions"]
BUTTONS = {"left": 1, "right": 2, "middle": 4}


class Chromium:
    def __init__(self, chromedriver, width, height, flags=(), patience=PATIENCE):
        options = webdriver.ChromeOptions()
        for flag in [*FLAGS, *flags]:
            options.add_argument(flag)
        options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
        self.driver = webdriver.Chrome(options=options, service=Service(chromedriver))
        self.driver.set_script_timeout(2 * patience)
        self.patience = patience
        self.held = ""
        self.resize(width, height)

    def command(self, name, **arguments):
        return self.driver.execute_cdp_cmd(name, arguments)

    def resize(self, width, height, scale=1):
        self.command("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=scale, mobile=False)

    def run(self, script, *arguments):
        return self.driver.execute_script(script, *arguments)

    def worked(self):
        """Seconds of a processor that the page has taken, whatever else the machine does."""
        self.command("Performance.enable", timeDomain="threadTicks")
        metrics = self.command("Performance.getMetrics")["metrics"]
        return next(each["value"] for each in metrics if each["name"] == "TaskDuration")

    # ---- a settled page

    def ask(self, call, *arguments):
        """What a function of settled.js comes to."""
        answer = self.driver.execute_async_script(f"""
            const [...all] = arguments, done = all.pop();
            window.hand.{call}(...all).then((it) => done({{it}}), ({{message}}) => done({{message}}));""", *arguments)
        if "message" in answer:
            raise AssertionError(answer["message"])
        return answer.get("it")

    def settle(self):
        """Until the studio has answered all that the page sent, and the page shows it."""
        self.ask("settled")

    @contextlib.contextmanager
    def still(self):
        """A settled page, which hears no message of the studio until the end."""
        self.ask("hold")
        try:
            yield
        finally:
            self.run("window.hand.release()")

    @contextlib.contextmanager
    def on(self, selector, text=None):
        """An element that the mouse finds and the place at which it does; the page stands still until the end. `text`: all
        that the element says."""
        place = self.ask("take", selector, text, 1000 * self.patience)
        try:
            yield place["it"], (place["x"], place["y"])
        finally:
            self.run("window.hand.release()")

    # ---- the mouse

    def mouse(self, kind, x, y, button="none", clicks=0, keys=0):
        held = BUTTONS.get(self.held, 0)
        self.command("Input.dispatchMouseEvent", type=kind, x=x, y=y, button=button, buttons=held, clickCount=clicks, modifiers=keys)

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

    def click_on(self, selector, text=None, **how):
        with self.on(selector, text) as (_, place):
            self.click(*place, **how)

    def drag(self, begin, end, steps=10, button="left", keys=0, drop=True):
        self.move(*begin)
        self.press(*begin, button, keys=keys)
        for step in range(1, steps + 1):
            self.move(*(a + (b - a) * step / steps for a, b in zip(begin, end)), keys=keys)
        if drop:
            self.release(*end, keys=keys)
