"""What is done to files: those of a folder of frames, and the source of its film."""
import json
import os
import shutil


def cut_short(path, dice):
    os.truncate(path, dice.randrange(path.stat().st_size))
    return f"{path.name} cut short to {path.stat().st_size} bytes"


def flip_a_bit(path, dice):
    bit = dice.randrange(8 * path.stat().st_size)
    with open(path, "r+b") as file:
        file.seek(bit // 8)
        byte = file.read(1)[0]
        file.seek(bit // 8)
        file.write(bytes([byte ^ 1 << bit % 8]))
    return f"bit {bit} of {path.name} flipped"


def remove(path, _):
    path.unlink()
    return f"{path.name} removed"


def empty(path, _):
    os.truncate(path, 0)
    return f"{path.name} is empty"


def make_a_pipe(path, _):
    path.unlink()
    os.mkfifo(path)
    return f"{path.name} is a FIFO"


def make_a_folder(path, _):
    path.unlink()
    path.mkdir()
    return f"{path.name} is a folder"


OF_RECORDS = (cut_short, flip_a_bit, remove)
OF_FRAMES = (empty, cut_short, flip_a_bit, remove, make_a_pipe, make_a_folder)


def damage(path, ways, dice):
    """What was done to the file; none where there is none, or nothing in it that could be damaged."""
    try:
        return dice.choice(ways)(path, dice) if path.is_file() and path.stat().st_size > 0 else None
    except FileNotFoundError:
        return None  # its owner has removed it meanwhile


def take_away(path):
    """A frame, whatever has its name."""
    if path.is_dir():
        shutil.rmtree(path)
    else:
        path.unlink(missing_ok=True)


class Source:
    """A film's file, which a person edits and puts back."""

    def __init__(self, path):
        self.path, self.text = path, path.read_text()

    def change(self, dice):
        way = dice.choice((self.edited, self.half_saved, self.deleted))
        return way(dice)

    def edited(self, dice):
        """Other pixels and a shorter film: what takes it, shows it."""
        film = json.loads(self.text)
        film["background"] = [dice.random() for _ in range(3)]
        film["frames"] = max(1, film["frames"] // 2)
        self.path.write_text(json.dumps(film))
        return "the film is edited"

    def half_saved(self, dice):
        self.path.write_text(self.text[:dice.randrange(len(self.text))])
        return "the film is saved by half"

    def deleted(self, _):
        self.path.unlink()
        return "the film is deleted"

    def put_back(self):
        whole = self.path.with_suffix(".whole")
        whole.write_text(self.text)
        whole.replace(self.path)
