"""The disk that has the film's folder: an image of its own, which every host of a cluster sees that is started
afterwards. It can be filled, hung, and copied as a power cut would leave it."""
import pathlib
import subprocess


def run(*words):
    done = subprocess.run(list(map(str, words)), capture_output=True, text=True)
    if done.returncode != 0:
        raise RuntimeError(f"{' '.join(map(str, words))}: {done.stderr.strip()}")


class Disk:
    def __init__(self, image, place, megabytes):
        self.image, self.place = pathlib.Path(image), pathlib.Path(place)
        self.megabytes = megabytes

    def __enter__(self):
        self.place.mkdir(parents=True, exist_ok=True)
        with open(self.image, "wb") as file:
            file.truncate(self.megabytes << 20)
        run("mkfs.ext4", "-q", "-m", "0", self.image)
        self.mount()
        return self

    def __exit__(self, *_):
        self.thaw()
        self.unmount()
        self.image.unlink()

    def mount(self, image=None):
        run("mount", "-o", "loop,noatime", image or self.image, self.place)

    def unmount(self):
        run("umount", "--lazy", self.place)

    @property
    def filler(self):
        return self.place / "filler"

    def fill(self):
        fill(self.place, self.filler)

    def empty(self):
        self.filler.unlink(missing_ok=True)

    def freeze(self):
        """Whoever writes waits, as for a file server that does not answer."""
        run("fsfreeze", "--freeze", self.place)

    def thaw(self):
        subprocess.run(["fsfreeze", "--unfreeze", self.place], capture_output=True)

    def copy_as_after_power_loss(self, image):
        """What has reached the disk; what Linux has not written yet is lost."""
        run("cp", "--sparse=always", self.image, image)


def fill(place, filler):
    """Until nothing more can be written there."""
    block = bytes(1 << 20)
    with open(filler, "ab", buffering=0) as file:
        while len(block) > 0:
            try:
                file.write(block)
            except OSError:
                block = block[:len(block) // 16]
