"""Starts a benchmark, as `run.py PROGRAM [ARGUMENT ...]`: what this machine lacks is said in one line, not by a
traceback, and Ctrl-C ends the benchmark quietly, after what it had begun is cleared away."""
import os
import pathlib
import runpy
import signal
import sys

PACKAGES = {"matplotlib": "python3-matplotlib", "numpy": "python3-numpy", "PIL": "python3-pil",
            "selenium": "python3-selenium", "websockets": "python3-websockets"}  # Debian's, by module
PROGRAMS = {"chromium": "chromium", "chromedriver": "chromium-driver", "ffmpeg": "ffmpeg",
            "git": "git", "mpirun": "openmpi-bin"}


def lacking(failure):
    """What is missing, and where it comes from; none where `failure` is another."""
    if isinstance(failure, ModuleNotFoundError):
        module = (failure.name or "").partition(".")[0]
        if module in PACKAGES:
            return (f"needs the module {module}, which {sys.executable} does not have "
                    f"(Debian: apt install {PACKAGES[module]})")
    if isinstance(failure, FileNotFoundError):
        program = os.fspath(failure.filename or "")
        if program in PROGRAMS:
            return f"needs the program {program}, which is not installed (Debian: apt install {PROGRAMS[program]})"
        if program.startswith(build_folder() + "/"):
            return f"needs {program}, which is not built (./bootstrap bench)"
    return None


def build_folder():
    return os.path.abspath(sys.argv[sys.argv.index("--build") + 1]) if "--build" in sys.argv[:-1] else "none"


def main():
    program = pathlib.Path(sys.argv[1])
    sys.argv = sys.argv[1:]
    sys.path[0] = str(program.parent)
    try:
        runpy.run_path(str(program), run_name="__main__")
    except KeyboardInterrupt:
        print(file=sys.stderr)
        signal.signal(signal.SIGINT, signal.SIG_DFL)
        os.kill(os.getpid(), signal.SIGINT)
    except (ModuleNotFoundError, FileNotFoundError) as failure:
        if (found := lacking(failure)) is None:
            raise
        sys.exit(f"mars bench {program.stem}: {found}")


if __name__ == "__main__":
    main()
