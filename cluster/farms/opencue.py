#!/usr/bin/env python3
"""Submits a film to OpenCue: opencue.py FILM DIR FRAMES [CHUNK]. Needs OpenCue's pyoutline."""
import os
import sys

from outline import Outline, cuerun
from outline.modules.shell import Shell


def job_of(film, folder, frames, chunk):
    job = Outline("mars-" + os.path.splitext(os.path.basename(film))[0])
    # Cuebot puts the frames of a task in place of #FRAMESPEC#, such as 7, 1-10 or 1-9x2.
    job.add_layer(Shell("render", range=frames, chunk=chunk,
                        command=["mars", "render", film, "-o", folder, "--frames", "#FRAMESPEC#", "--restarts", "0"]))
    return job


def main(film, folder, frames, chunk="24"):
    cuerun.launch(job_of(os.path.abspath(film), os.path.abspath(folder), frames, int(chunk)), use_pycuerun=False)


if __name__ == "__main__":
    main(*sys.argv[1:])
