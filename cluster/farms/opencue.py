#!/usr/bin/env python3
"""Submits a film to OpenCue: opencue.py FILM DIR FRAMES [CHUNK], as film.json frames 0-239 24.
Needs OpenCue's pyoutline."""
import os
import sys


def job_of(film, folder, frames, chunk):
    from outline import Outline
    from outline.modules.shell import Shell

    job = Outline("mars-" + os.path.splitext(os.path.basename(film))[0])
    # Cuebot puts the frames of a task in place of #FRAMESPEC#, such as 7, 1-10 or 1-9x2.
    render = Shell("render", range=frames, chunk=chunk,
                   command=["mars", "render", film, "-o", folder, "--frames", "#FRAMESPEC#", "--restarts", "0"])
    verify = Shell("verify", range="0", command=["mars", "verify", folder])
    job.add_layer(render)
    job.add_layer(verify)
    verify.depend_all(render)
    return job


def main(film, folder, frames, chunk="24"):
    from outline import cuerun

    cuerun.launch(job_of(os.path.abspath(film), os.path.abspath(folder), frames, int(chunk)), use_pycuerun=False)


if __name__ == "__main__":
    if len(sys.argv) not in (4, 5) or not sys.argv[-1].isdigit() and len(sys.argv) == 5:
        sys.exit(__doc__)
    main(*sys.argv[1:])
