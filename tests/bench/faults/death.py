"""One death, as planted/death.cpp plans it."""
import os
import signal
from dataclasses import dataclass

SIGNALS = (signal.SIGKILL, signal.SIGSEGV, signal.SIGBUS, signal.SIGABRT, signal.SIGTERM)
NAMED = ("fork", "link", "init", "initialized", "finalize", "finalized")


@dataclass
class Death:
    program: str  # a pattern, as a shell's
    rank: int     # -1: any
    moment: str   # a name, a message ("still:3"), or milliseconds from its fork
    signal: int

    def __str__(self):
        rank = f" {self.rank}" if self.rank >= 0 else ""
        when = self.moment if self.moment in NAMED or ":" in self.moment else f"{self.moment} ms"
        return f"{signal.Signals(self.signal).name} of {self.program}{rank} at {when}"

    def environment(self, library, plan):
        """For mars: `plan` is a file that is gone, and `plan`.taken too, once it has happened."""
        plan.write_text(f"{self.program} {self.rank} {self.moment} {int(self.signal)}\n")
        others = os.environ.get("LD_PRELOAD")
        return {"DEATH": str(plan), "LD_PRELOAD": f"{library}:{others}" if others else str(library)}
