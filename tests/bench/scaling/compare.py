#!/usr/bin/env python3
"""What differs beyond noise: between A and B of one study of mars bench scaling
--against, which took turns, or between two studies, A and B, made one after the
other (folders, or their files runs.jsonl). The film's time and the processors'
seconds are compared; where they differ, the steps and the machines too.

Answers: slower or faster and by how much, the same within so much, or cannot
tell. Two studies are only compared where the machine was quiet during both.

Exit code: 0 B is not slower; 1 it is; 2 the files cannot be compared; 3 cannot
tell."""
import argparse
import sys

import runs
import study

try:
    import answers
    import changes
    import results
except ModuleNotFoundError as missing:  # exit code 1 would say that B is slower
    print(f"mars bench compare: {missing} (Debian: python3-numpy)", file=sys.stderr)
    sys.exit(2)


def read_command_line():
    parser = argparse.ArgumentParser(prog="mars bench compare", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", help=argparse.SUPPRESS)
    parser.add_argument("a", metavar="A", help="a study; one with --against alone")
    parser.add_argument("b", metavar="B", nargs="?", help="a study that was made later")
    parser.add_argument("--level", type=float, default=changes.LEVEL,
                        help="probability with which noise alone may be reported; default: %(default)s")
    wanted = parser.parse_args()
    if not 0 < wanted.level < 1:
        parser.error("--level lies between 0 and 1")
    return wanted


def compared(wanted):
    found = [results.Results([runs.read(path)]) for path in (wanted.a, wanted.b) if path]
    if len(found) == 1:
        if not found[0].compares:
            raise study.Trouble(f"{wanted.a} has runs of one program that ended well, and none of another: name a second "
                                "study, or measure with --against" + "".join(f"\n{run['failure']}" for run in found[0].failures[:1]))
        return changes.of_programs(found[0], wanted.level)
    if any(each.compares for each in found):
        raise study.Trouble("a study of two programs is compared alone: mars bench compare STUDY")
    return changes.of_studies(*found, wanted.level)


def exit_code(comparison):
    if any(change.slower for change in comparison.times):
        return 1
    film = comparison.times[0]
    return 0 if film.holds or film.within is not None else 3


def main():
    comparison = compared(read_command_line())
    print(answers.tables(comparison))
    print("\n".join(answers.sentences(comparison)))
    return exit_code(comparison)


if __name__ == "__main__":
    try:
        sys.exit(main())
    except study.Trouble as trouble:
        print(f"mars bench compare: {trouble}", file=sys.stderr)
        sys.exit(2)
