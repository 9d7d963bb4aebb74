"""Mutants are found where code is and nowhere else, compile to a program that is each of them, are chosen as a seed
says, and tests that run as mutants end in time. Takes the C++ compiler."""

import contextlib
import io
import os
import pathlib
import subprocess
import sys
import tempfile
import time
import unittest
import unittest.mock

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent)]
import mutants  # noqa: E402
import trials  # noqa: E402
from candidates import Source, with_choices  # noqa: E402
from cases import main  # noqa: E402

COMPILER = sys.argv[1] if len(sys.argv) > 1 else "c++"

CODE = """#include <algorithm>
#include <cstdio>

namespace {

constexpr int kTable[] = {1, 2};  // 3 < 4
constexpr int kMost = 8;

bool is_small(int number) {
  if (number > 100) return false;
  return number < 9;
}

template <typename T>
T sum(const T* begin, int count) {
  T all = 0;
  for (int i = 0; i < count; ++i) {
    all += begin[i] * 2;
  }
  return all;
}

int clamped(int number) { return std::min<int>(number, kMost); }

struct Counter {
  int start = 7;
  int count(bool one, bool other, bool third) { return one || other && third ? 4 : 5; }
};

}  // namespace

int main() {
  const char* sentence = "1 < 2 && 3";
  int last = sum(kTable, 2) - 'a';
  last = kMost;
  Counter counter;
  std::printf("%d\\n", is_small(9) + 10 * clamped(9) + 100 * last + 1000 * counter.count(true, true, false));
  return sentence == nullptr;
}
"""


def pairs(text):
    return [(mutant.kind, *mutant.before, *mutant.after) for mutant in Source("a.cpp", text).mutants()]


def within(line, head="int f()"):
    """Kinds and lines of the mutants of a line of a function."""
    return [(kind, after) for kind, before, after in pairs(f"{head} {{\n  {line}\n}}\n")]


class Found(unittest.TestCase):
    def test_operators_and_numbers(self):
        self.assertEqual(within("x = a<b>(c) < d;"), [("boundary", "x = a<b>(c) <= d;"), ("removal", ";")])
        self.assertEqual(within("const auto* x = a - -2;"),
                         [("arithmetic", "const auto* x = a + -2;"), ("number", "const auto* x = a - -3;")])
        self.assertEqual(within("T&& x = a != b;"), [("condition", "T&& x = a == b;")])
        self.assertEqual(within("const int y = std::max(a, b);"), [("extreme", "const int y = std::min(a, b);")])
        self.assertEqual(within("auto y = std::vector<std::array<int, 3>>(1'000u);"),
                         [("number", "auto y = std::vector<std::array<int, 3>>(1001u);")])

    def test_statements(self):
        self.assertEqual(within("if (ready()) all.at(i)->add({one, two});"), [("removal", "if (ready()) ;")])
        self.assertEqual(within("for (auto& each : all) each.x += y;"), [("removal", "for (auto& each : all) ;")])
        self.assertEqual(within("Thing thing(one);"), [])
        self.assertEqual(within("delete one;"), [])

    def test_results_of_functions_that_return_bool(self):
        self.assertEqual(within("if (a) return is(b);", "bool C::f(int a) const"),
                         [("result", "if (a) return !(is(b));")])
        self.assertEqual(within("return is(b);", "int C::f(bool a)"), [])
        self.assertEqual(within("return true;", "const auto f = [](int a)"), [("result", "return !(true);")])

    def test_nothing_where_no_code_runs_or_only_words_change(self):
        for text in ["// a < b\n", "#define X a < b\n", "int a = 1;\n", "struct S {\n  int a = 2;\n};\n",
                     "enum E { a = 1 };\n"]:
            self.assertEqual(pairs(text), [], text)
        for line in ['throw Failure("a", b + c);', "static_assert(a < b);", "constexpr int a = 1;", "case 3: break;",
                     'say("it is " + a);', "std::cout << a + b;", "/* a < b */", 'const auto x = R"(a < 1)";',
                     "check(a < b);"]:
            self.assertEqual(within(line), [], line)

    def test_a_condition_before_a_failure(self):
        self.assertEqual(within('if (a < b) throw Failure("no b");'),
                         [("boundary", 'if (a <= b) throw Failure("no b");')])

    def test_operands_are_those_of_the_changed_text(self):
        source = Source("a.cpp", "int f() {\n  g(h, a + b[c + 1] * d < e || i && j);\n}\n")
        changed = {mutant.changed for mutant in source.mutants()}
        self.assertLessEqual({"a - b[c + 1] * d", "b[c + 1] / d", "c - 1", "a + b[c + 1] * d <= e",
                              "a + b[c + 1] * d < e && i && j", "a + b[c + 1] * d < e || i || j"}, changed)


class Compiled(unittest.TestCase):
    def test_one_program_is_each_mutant(self):
        apart = []  # none in another
        for mutant in sorted(Source("a.cpp", CODE).mutants(), key=lambda mutant: mutant.end - mutant.begin):
            if all(mutant.end <= other.begin or other.end <= mutant.begin for other in apart):
                apart.append(mutant)
        with tempfile.TemporaryDirectory() as folder:
            source, program = pathlib.Path(folder) / "a.cpp", pathlib.Path(folder) / "a"
            source.write_text(with_choices(CODE, dict(enumerate(apart, 1))))
            subprocess.run([COMPILER, "-std=c++20", f"-I{HERE.parents[1]}", source, "-o", program], check=True)
            run = lambda more: subprocess.run([program], env={**os.environ, **more}, capture_output=True, text=True)
            said = lambda **more: run(more).stdout
            self.assertEqual(said(), "4880\n")
            self.assertEqual(said(MUTANT_OF_MARS="0"), "4880\n")
            found = {mutant.before + mutant.after: said(MUTANT_OF_MARS=str(number))
                     for number, mutant in enumerate(apart, 1)}
        self.assertEqual(found["return number < 9;", "return number < 10;"], "4881\n")
        self.assertEqual(found["last = kMost;", ";"], "-5020\n")
        clamped = "int clamped(int number) {{ return std::{}<int>(number, kMost); }}"
        self.assertEqual(found[clamped.format("min"), clamped.format("max")], "4890\n")


class Chosen(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        rooms = [place.replace("(keys|document)", "keys").replace("(cli|child)", "cli") for place in mutants.PLACES]
        for room in rooms:
            (self.folder / room).mkdir(parents=True)
            for i in range(3):
                lines = "".join(f"  x{number} = a{number} + b;\n" + "\n" * 12 for number in range(5))
                (self.folder / room / f"s{i}.cpp").write_text(f"int f() {{\n{lines}}}\n")
        (self.folder / "MAP.md").write_text("".join(f"| `{room}/` | a room |\n" for room in rooms))

    def choose(self, seed, passed_over={}, compiles=lambda mutant: True):
        return mutants.Chooser(self.folder, seed, passed_over, compiles).choose(30)

    def test_by_the_seed(self):
        chosen = self.choose(50)
        self.assertEqual(chosen, self.choose(50))
        self.assertNotEqual(chosen, self.choose(51))
        rooms = [mutant.file.rpartition("/")[0] for mutant in chosen]
        self.assertEqual(len(set(rooms)), len(mutants.PLACES))
        self.assertLessEqual(max(map(rooms.count, rooms)), mutants.MOST_IN_A_ROOM)

    def test_the_next_in_place_of_what_is_passed_over_or_does_not_compile(self):
        chosen = self.choose(50)
        for others in (self.choose(50, {chosen[3]: "is the same"}),
                       self.choose(50, {}, lambda mutant: mutant != chosen[3])):
            self.assertNotEqual(others[3], chosen[3])
            self.assertEqual(others[:3] + others[4:], chosen[:3] + chosen[4:])

    def test_lists_can_be_read(self):
        chosen = self.choose(50)
        blocks = ["# heading", mutants.block_of(7, chosen[0]), mutants.block_of("passed over", chosen[1], ": why")]
        numbered, passed_over = mutants.read_list("\n\n".join(blocks) + "\n")
        self.assertEqual(numbered[7].key(), chosen[0].key())
        self.assertEqual([(mutant.key(), why) for mutant, why in passed_over.items()], [(chosen[1].key(), "why")])

    def test_mutants_are_found_where_their_lines_moved(self):
        file = self.folder / "topology/s0.cpp"
        found = Source("topology/s0.cpp", file.read_text()).mutants()
        moved, gone = [mutant for mutant in found if mutant.kind == "arithmetic"][:2]
        file.write_text("\n\n" + file.read_text().replace(gone.before[0], "return 2;"))
        subprocess.run(["git", "init", "-q", self.folder], check=True)
        subprocess.run(["git", "-C", self.folder, "add", "."], check=True)
        copy = self.folder / "copy"
        digest, there = mutants.copy_sources(self.folder, copy, {1: moved, 2: gone})
        self.assertEqual(there, {1})
        self.assertIn("(::mutants::on(1) ?", (copy / "topology/s0.cpp").read_text())
        self.assertEqual(mutants.copy_sources(self.folder, copy, {1: moved})[0], digest)


class Run(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def made(self, name, script, **properties):
        properties = {"LABELS": ["unit"], **properties, "WORKING_DIRECTORY": str(self.folder)}
        listed = [{"name": key, "value": value} for key, value in properties.items()]
        return trials.Test({"name": name, "command": ["sh", "-c", script], "properties": listed})

    def outcomes(self, *tests, limit=20):
        return {test.name: how for test, how, _ in trials.outcomes(tests, 7, lambda test: limit, self.folder)}

    def test_outcomes(self):
        found = self.outcomes(
            self.made("good", '[ "$MUTANT_OF_MARS$MORE" = 7more ]', ENVIRONMENT=["MORE=more"]),
            self.made("bad", "exit 1"), self.made("crash", "kill -SEGV $$"),
            self.made("away", "exit 77", SKIP_RETURN_CODE=77),
            self.made("absent", "echo none", SKIP_REGULAR_EXPRESSION=["."], PROCESSORS=2))
        self.assertEqual(found, {"good": "passed", "bad": "failed", "crash": "SIGSEGV", "away": "skipped",
                                 "absent": "skipped"})

    def test_nothing_outlives_its_time(self):
        file = self.folder / "left"
        endless = self.made("endless", f"TMPDIR=/dev/shm setsid sleep 60 & echo $! > {file}; wait")
        self.assertEqual(self.outcomes(endless, limit=0.5),
                         {"endless": "time-out"})
        left = pathlib.Path(f"/proc/{file.read_text().strip()}/cmdline")
        end = time.monotonic() + 10
        while left.exists() and left.read_bytes() and time.monotonic() < end:
            time.sleep(0.02)
        self.assertFalse(left.exists() and left.read_bytes())

    def test_a_mutant_is_found_by_what_fails_twice_and_stays_found(self):
        mutant = Source("hal/a.cpp", "int f() {\n  x = a + b;\n}\n").mutants()[0]
        once = self.made("hal_once_test",
                         "[ $MUTANT_OF_MARS = 0 ] || if [ -e once ]; then touch twice; else ! touch once; fi")
        after = self.made("last_test",
                          "[ $MUTANT_OF_MARS = 0 ] || { until [ -e twice ]; do sleep 0.01; done; exit 1; }")
        tests = [self.made("always_test", "exit 1"), after, once]
        said = io.StringIO()
        with unittest.mock.patch("trials.tests_of", lambda build: tests), contextlib.redirect_stdout(said):
            judge = mutants.Judge(self.folder, "of these sources", ["quick"])
            judge.run_reference()
            self.assertEqual(judge.judge(7, mutant), "quick")
            again = mutants.Judge(self.folder, "of these sources", ["quick"])
            other = mutants.Judge(self.folder, "of others", ["quick"])
        found = again.kept["mutants"][repr(mutant.key())]["quick"]
        self.assertEqual((found["found"], found["how"], found["unsure"]), ("last_test", "failed", ["hal_once_test"]))
        self.assertEqual(set(again.reference), {"always_test", "last_test", "hal_once_test"})
        self.assertEqual(other.kept["mutants"], {})
        self.assertIn("always_test is left out: failed without a mutant", said.getvalue())

    def test_damaged_results_count_as_none(self):
        file, said = self.folder / "results.json", io.StringIO()
        nothing = {"digest": "of these sources", "reference": {}, "mutants": {}}
        for text in ["", "[]", "{}", '{"digest": "of these sources", "reference": []}']:
            file.write_text(text)
            with contextlib.redirect_stdout(said):
                self.assertEqual(mutants.kept_results(file, "of these sources"), nothing)
        self.assertEqual(said.getvalue().count(f"{file} is damaged"), 4)

    def test_numbers_without_a_mutant_are_refused_before_anything_is_built(self):
        with self.assertRaisesRegex(SystemExit, "list.txt has no 99; its last is 30"):
            mutants.run(self.folder, ["quick"], {1, 99})
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_tiers_and_order(self):
        tiers = [self.made("a_test", "", LABELS=[label]).tier() for label in ["unit", "world", "rule", "cluster"]]
        self.assertEqual(tiers, ["quick", "all", None, None])
        near, far, away = [self.made(name, "").nearness("host/studio/stage/hand.cpp")
                           for name in ("studio_stage_test", "studio_test", "farm_test")]
        self.assertTrue(near > far > away == 0)


if __name__ == "__main__":
    main()
