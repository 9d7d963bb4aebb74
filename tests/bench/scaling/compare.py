#!/usr/bin/env python3
"""What changed beyond noise between two studies of mars bench scaling (folders, or
their files runs.jsonl): the time of each configuration, the time by step, and
the machines.

Exit code: 0 nothing became slower; 1 something did; 2 the files cannot be
compared."""
import argparse
import sys

import runs
import study

try:
    import changes
    import results
    from table import fraction_text, seconds_text
except ModuleNotFoundError as missing:  # exit code 1 would say that something became slower
    print(f"mars bench compare: {missing} (Debian: python3-numpy)", file=sys.stderr)
    sys.exit(2)


def read_command_line():
    parser = argparse.ArgumentParser(prog="mars bench compare", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", help=argparse.SUPPRESS)
    parser.add_argument("before", metavar="A.jsonl")
    parser.add_argument("after", metavar="B.jsonl")
    parser.add_argument("--level", type=float, default=0.05,
                        help="probability with which noise alone may be reported; default: 0.05")
    return parser.parse_args()


def verdict(change, level):
    if change.holds(level):
        return "slower" if change.slower else "faster"
    return f"needs {change.wanted} repeats" if change.wanted else ""


def rows(title, compared, level):
    width = max(len(title), *(len(change.name) for change in compared))
    yield f"{title.ljust(width)}  {'before':>9}  {'after':>9}  {'median':>7}  {'best':>6}  {'chance':>7}"
    for change in compared:
        yield (f"{change.name.ljust(width)}  {seconds_text(change.before):>9}  {seconds_text(change.after):>9}  "
               f"{change.ratio:7.3f}  {change.best:6.3f}  {change.probability:7.4f}  {verdict(change, level)}").rstrip()


def summary(comparison):
    film, cause = comparison.times[0], comparison.cause()
    if film.holds(comparison.level):
        how = "slower" if film.slower else "faster"
        yield f"Over all configurations: {how}, {film.ratio:.3f} of the time before."
    else:
        yield "Over all configurations: no change of the film's time beyond noise."
    if cause:
        yield (f"Step: {cause.name}, {'slower' if cause.slower else 'faster'}: {seconds_text(cause.before)} to "
               f"{seconds_text(cause.after)} of a mean node.")


def slow_machines(after):
    for slow in after.slow:
        yield f"Slow in B: {slow.name}, {slow.times:.2f} times as long as the others for the same work."


def caveats(comparison):
    for title, nodes in comparison.only_one:
        yield f"Only in one of the files: {title}, nodes {nodes}."
    for title, nodes in comparison.other_films:
        yield f"Other films, sizes or samples of the same name: {title}, nodes {nodes}."
    yield (f"Level {comparison.level}; chance: rank tests with Holm's correction within each table. Changes below "
           f"{fraction_text(changes.LEAST)} are not reported.")


def main():
    wanted = read_command_line()
    before, after = (results.Results([runs.read(path)]) for path in (wanted.before, wanted.after))
    comparison = changes.Comparison(before, after, wanted.level)
    if not comparison.pairs:
        raise study.Trouble("the two files have no configuration in common")
    tables = [("configuration", comparison.times), ("step", comparison.steps)]
    tables += [("machine, computing", comparison.machines)] if len(comparison.machines) > 1 else []
    for title, compared in tables:
        print("\n".join(rows(title, compared, wanted.level)) + "\n")
    print("\n".join([*summary(comparison), *slow_machines(after), *caveats(comparison)]))
    return int(any(change.holds(wanted.level) and change.slower for change in comparison.times))


if __name__ == "__main__":
    try:
        sys.exit(main())
    except study.Trouble as trouble:
        print(f"mars bench compare: {trouble}", file=sys.stderr)
        sys.exit(2)
