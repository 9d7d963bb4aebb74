"""Where a run happened: whatever may explain its times later, as JSON. Reads /proc and /sys; absent facts are None."""
import os
import platform
import re
import socket
import subprocess

SETTINGS = ("MARS_", "OMPI_MCA_", "PRTE_MCA_", "SLURM_JOB_ID", "SLURM_JOB_NODELIST", "SLURM_NTASKS",
            "SLURM_JOB_PARTITION", "SLURM_CPUS_PER_TASK")

OWN = "processors of this machine"


def content(path):
    try:
        with open(path) as file:
            return file.read().strip()
    except OSError:
        return None


def first_line(*command):
    """What a program prints first; None where it is not there or fails."""
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=20)
    except (OSError, subprocess.TimeoutExpired):
        return None
    lines = done.stdout.strip().splitlines()
    return lines[0] if done.returncode == 0 and lines else None


def found(pattern, text):
    match = re.search(pattern, text or "", re.MULTILINE)
    return match.group(1).strip() if match else None


def hosts_in(hostfile):
    """Slots by machine, as mpirun counts them."""
    slots = {}
    for line in (content(hostfile) or "").splitlines():
        words = line.partition("#")[0].split()
        if words:
            slots[words[0]] = slots.get(words[0], 0) + int(found(r"slots=(\d+)", line) or 1)
    return slots


def processors(hostfile=None):
    """Those that the nodes and the host may use, and who says so."""
    if hostfile:
        return sum(hosts_in(hostfile).values()), "slots of the hostfile"
    if os.environ.get("SLURM_NTASKS"):
        return int(os.environ["SLURM_NTASKS"]), "tasks of the Slurm job"
    return len(os.sched_getaffinity(0)), OWN


def build_of(mars):
    """Of the program `mars`. One that is not in a build's folder says its version alone."""
    cache = content(os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(mars))), "CMakeCache.txt"))
    sources = found(r"^CMAKE_HOME_DIRECTORY:\w+=(.*)", cache)
    return {"program": mars, "version": first_line(mars, "--version"),
            "commit": sources and first_line("git", "-C", sources, "describe", "--always", "--dirty", "--abbrev=12"),
            "build_type": found(r"^CMAKE_BUILD_TYPE:\w+=(.*)", cache),
            "compiler": cache and first_line(found(r"^CMAKE_CXX_COMPILER:\w+=(.*)", cache) or "c++", "--version")}


def environment(mars, hostfile=None):
    """All that stays the same through a study, of the machine that starts it."""
    count, counted = processors(hostfile)
    return {
        "machine": socket.gethostname(),
        "cpu": found(r"^model name\s*:(.*)", content("/proc/cpuinfo")) or platform.machine(),
        "cores": os.cpu_count(),
        "processors": count,
        "processors_are": counted,
        "governor": content("/sys/devices/system/cpu/cpu0/cpufreq/scaling_governor"),
        "memory_kib": int(found(r"^MemTotal:\s*(\d+)", content("/proc/meminfo")) or 0) or None,
        "system": f"{platform.system()} {platform.release()}",
        "mpi": first_line("mpirun", "--version"),
        "mars": build_of(mars),
        "hosts": hosts_in(hostfile) if hostfile else None,
        "variables": {name: value for name, value in sorted(os.environ.items()) if name.startswith(SETTINGS)},
    }


def load_average():
    """Processes that ran or wanted to, on average of the last minute."""
    return round(os.getloadavg()[0], 2)
