"""PPM pictures, and how alike two are."""
import collections
import operator


def read(path):
    """(width, height) and the bytes of a picture as the competitors write it."""
    with open(path, "rb") as file:
        words = []
        while len(words) < 4:
            words += file.readline().partition(b"#")[0].split()
        pixels = file.read()
    width, height = map(int, words[1:3])
    if words[0] != b"P6" or words[3] != b"255" or len(pixels) != 3 * width * height:
        raise ValueError(f"{path}: not a whole PPM picture")
    return (width, height), pixels


def rms(one, other):
    """Root of the mean square difference of two files' levels, of 255."""
    (size, a), (other_size, b) = read(one), read(other)
    if size != other_size:
        raise ValueError(f"{one} and {other} differ in size")
    differences = collections.Counter(map(operator.sub, a, b))
    return (sum(d * d * count for d, count in differences.items()) / len(a)) ** 0.5
