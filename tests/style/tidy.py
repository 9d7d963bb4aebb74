#!/usr/bin/env python3
"""Runs clang-tidy with the project's .clang-tidy:

  tidy.py BUILD              over all sources below topology/, hal/, node/ and host/ that BUILD compiles
  tidy.py BUILD FOLDER ...   over those below these folders of the project

BUILD has a compile_commands.json. Each finding is printed once. Exit code 1 where there is one, or where the time of
--seconds (default: 3600) is over; processes: as many as processors.
"""

import argparse
import concurrent.futures
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
FOLDERS = ["topology", "hal", "node", "host"]
FINDING = re.compile(r"^\S.*: (warning|error): .*\[[\w.,-]+\]$", re.M)


def program():
    """clang-tidy of the version that .clang-tidy is for; none where there is none."""
    for name in ["clang-tidy-14", "clang-tidy"]:
        path = shutil.which(name)
        if path and "version 14." in subprocess.run([path, "--version"], capture_output=True, text=True).stdout:
            return path
    return None


def check(clang_tidy, commands, source, seconds):
    """What clang-tidy says of one source; a word about its time where that is over."""
    words = [clang_tidy, "--quiet", f"--config-file={ROOT / '.clang-tidy'}", "-p", commands,
             f"--extra-arg-before=-isystem{ROOT / 'tests/style/clang14'}", source]
    try:
        done = subprocess.run(words, capture_output=True, text=True, timeout=max(seconds, 0.001))
    except subprocess.TimeoutExpired:
        return f"{source}: error: not checked, for the time is over [seconds]\n"
    if done.returncode != 0 and not FINDING.search(done.stdout):
        return f"{source}: error: clang-tidy ended with {done.returncode}: {done.stderr.strip()} [clang-tidy]\n"
    return done.stdout


def commands_of(build):
    """How each source is compiled: one that is compiled together with others, as if alone."""
    for command in json.loads((pathlib.Path(build) / "compile_commands.json").read_text()):
        compiled = pathlib.Path(command["directory"], command["file"])
        if compiled.parent.name != "Unity":
            yield command
            continue
        for source in re.findall(r'^#include "(.*)"$', compiled.read_text(), re.M):
            yield command | {"file": source, "command": command["command"].replace(str(compiled), source)}


def sources_below(commands, folders):
    files = {pathlib.Path(command["directory"], command["file"]) for command in commands}
    folders = [ROOT / folder for folder in folders]
    return sorted(file for file in files if any(folder in file.parents for folder in folders) and file.suffix == ".cpp")


def findings_of(text):
    """Each finding with the lines that show it."""
    starts = [found.start() for found in FINDING.finditer(text)]
    return [text[start:end] for start, end in zip(starts, starts[1:] + [len(text)])]


def is_ours(finding, source):
    """Not in a header of others, whose declarations some checks compare with ours."""
    return finding.startswith((f"{ROOT}/", f"{source}:"))


def check_all(clang_tidy, commands, sources, seconds):
    """Prints each finding once, as it comes; the number of findings."""
    end = time.monotonic() + seconds
    seen = set()
    with concurrent.futures.ThreadPoolExecutor(len(os.sched_getaffinity(0))) as pool:
        texts = pool.map(lambda source: check(clang_tidy, commands, source, end - time.monotonic()), sources)
        for source, text in zip(sources, texts):
            for finding in [each for each in findings_of(text) if is_ours(each, source)]:
                if finding not in seen:
                    print(finding, end="", flush=True)
                seen.add(finding)
    return len(seen)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build")
    parser.add_argument("folders", nargs="*", default=FOLDERS)
    parser.add_argument("--seconds", type=float, default=3600)
    words = parser.parse_args()
    clang_tidy = program()
    if not clang_tidy:
        sys.exit("tidy: clang-tidy 14 is not here (Debian 12: apt-get install clang-tidy)")
    commands = list(commands_of(words.build))
    sources = sources_below(commands, words.folders)
    if not sources:
        sys.exit(f"tidy: {words.build} compiles nothing below {', '.join(words.folders)}")
    with tempfile.TemporaryDirectory(prefix="mars-tidy-") as folder:
        (pathlib.Path(folder) / "compile_commands.json").write_text(json.dumps(commands))
        count = check_all(clang_tidy, folder, sources, words.seconds)
    print(f"tidy: {len(sources)} files, {count} findings")
    sys.exit(count > 0)


if __name__ == "__main__":
    main()
