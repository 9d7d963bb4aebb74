"""What a command takes of this machine, and what other programs take of it meanwhile."""
import os
import subprocess
import time
from dataclasses import dataclass

TICK = os.sysconf("SC_CLK_TCK")


@dataclass(frozen=True)
class Usage:
    """Of a command with all processes that it started here, up to its end."""
    failure: str               # what it printed to standard error; "" where it succeeded
    wall_seconds: float
    processor_seconds: float   # user's and system's
    involuntary_switches: int  # how often a process had to give its processor to another
    others_seconds: float      # of all processors, taken by other programs or, on a virtual machine, by other machines


def busy_seconds():
    """For which the machine's processors have not been idle."""
    with open("/proc/stat") as file:
        user, nice, system, _, _, interrupts, soft, steal, *_ = map(int, file.readline().split()[1:])
    return (user + nice + system + interrupts + soft + steal) / TICK


def run(command):
    busy, begin = busy_seconds(), time.monotonic()
    with subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True) as process:
        try:
            printed = process.stderr.read()
        except BaseException:
            process.terminate()
            raise
        _, status, used = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
    own = used.ru_utime + used.ru_stime
    failure = (printed.strip() or f"ended with {process.returncode}") if process.returncode != 0 else ""
    return Usage(failure, time.monotonic() - begin, own, used.ru_nivcsw, max(0.0, busy_seconds() - busy - own))
