"""What a unit of the 1992 program's work (work.h) costs an 80386 with an 80387: the operations that a plain C program
takes for it, in single precision, by published clocks.

Clocks: the data sheets of the 80386 and the 80387; the 387 column of the x87 tables that are in circulation
(https://zs3.me/intel_f.html) has the same. Of ranges the middle. Operands come from memory, as C compilers of the time
had it. Without wait states, and no time for what the compiler adds: one speed for all is fitted."""

HERTZ = 16e6
CLOCKS = {
    "load": 20,      # FLD m32
    "store": 44,     # FSTP m32
    "add": 28,       # FADD, FSUB m32: 24 to 32
    "multiply": 31,  # FMUL m32: 27 to 35
    "divide": 89,    # FDIV m32
    "root": 126,     # FSQRT: 122 to 129
    "compare": 47,   # FCOMP m32 26, FSTSW AX 13, SAHF 3, a jump 5
    "integer": 86,   # FISTP m32: 79 to 93
    "move": 4,       # MOV from memory; to memory it is 2
    "step": 12,      # of a loop: INC 2, CMP 2, a jump that is taken 8
}
# Values that go along edges and lines: depth and the normal, on edges the column too.
OPERATIONS = {
    # 3 rows of matrix x place and x normal, 1 / w, two places in the picture, normal / w.
    "vertex": {"multiply": 25, "add": 17, "divide": 1, "load": 12, "store": 12, "integer": 2},
    "polygon": {"multiply": 2, "add": 5, "compare": 1, "load": 3},
    # Of 3 edges the steps of 5 values from line to line; corners sorted.
    "set_up": {"add": 18, "multiply": 15, "divide": 3, "load": 18, "store": 18, "compare": 3},
    # 5 values at both ends go a line further and into the box, which goes into a list.
    "edge_box": {"add": 10, "load": 10, "store": 10, "integer": 2, "move": 18, "step": 2},
    # 18 words of 4 bytes.
    "pass_on": {"move": 36, "step": 4},
    "line": {"add": 1, "load": 1, "store": 1, "move": 3, "step": 3},
    # The steps of 4 values from pixel to pixel.
    "span": {"add": 5, "multiply": 4, "divide": 1, "load": 5, "store": 4, "step": 2},
    # 4 values go a pixel further; the depth is compared.
    "pixel": {"add": 4, "load": 4, "store": 4, "compare": 1, "step": 1},
    # The normal made a unit, N.L, R.V with the eye far away, (R.V)^32 by squaring, three colours as bytes.
    "shading": {"multiply": 23, "add": 9, "root": 1, "divide": 1, "compare": 5, "integer": 3, "load": 8, "store": 6,
                "move": 6},
    "clear": {"move": 2, "step": 1},
    "look": {"move": 1, "step": 1.5},
    "copy": {"move": 2, "step": 1},
}
WORKS = [*OPERATIONS, "depth"]


def clocks_of(work):
    return sum(CLOCKS[operation] * count for operation, count in OPERATIONS[work].items())


def seconds(speed, depth):
    """Of a unit of each work, in the order of WORKS. speed: how many times the published clocks pass; depth: seconds for
    one of the depths that other nodes send."""
    return [speed * clocks_of(work) / HERTZ for work in OPERATIONS] + [depth]
