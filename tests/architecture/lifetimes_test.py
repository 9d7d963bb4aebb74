"""Classes that keep a reference, and functions that return one, refuse temporaries. GCC 12 warns of few that are gone
when they are used, and sanitizers see only what a test makes. So where a class of a header keeps a `const T&`, a
pointer or a view of what its constructor is given, and where a function of a header may return a reference or pointer
to what it is given, there is an overload for temporaries, `const T&&`, which is deleted; for views it takes the
std::string or std::vector itself.

The rule is for private members in headers. The classes of one source file are used in sight of their constructors,
mostly on one line; an aggregate lengthens the life of what its braces hold; and kernels share no class with others."""
import pathlib
import re
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from cases import main  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]
CLASS = re.compile(r"^( *)(?:class|struct) (\w+)[^;{]*\{\n(.*?)^\1\};", re.S | re.M)
KEPT = re.compile(r"^ +(?:mutable )?(?:const ([^;(=]+)[&*]|(std::string_view|std::span<const [^;(=]+>)) "
                  r"\w+_(?: = nullptr)?;", re.M)
FUNCTION = re.compile(r"^(?:  static |inline )?const [\w:<>]+[&*] (\w+)(\([^;{}]*?\))(?: const)?( = delete)?[;{ ]",
                      re.S | re.M)
# They return what belongs to tables and films, or what a span or pointer of theirs shows.
FOREIGN = {"kind_of", "pairs_of", "copy_runs"}


def takes(parameters, kind):
    return re.search(rf"[(,]\s*(?:const )?{re.escape(kind)}&? \w+[,)=]", parameters) is not None


def refuses(declarations, kind):
    """Whether one of the deleted declarations takes a temporary of the kind."""
    is_view = kind.startswith(("std::string_view", "std::span"))
    temporary = r"std::same_as<std::(?:string|vector<.*>)> auto&&" if is_view else rf"const {re.escape(kind)}&&"
    return any(re.search(temporary, each) for each in declarations)


def careless_constructors(text):
    """Classes that keep what a constructor is given, and the kinds of it of which they take temporaries."""
    found = []
    for _, name, body in CLASS.findall(text):
        constructors = re.findall(rf"^ +(?:explicit )?{name}(\([^;{{]*?\))( = delete)?(?:;| *\{{|\s*:)", body,
                                  re.S | re.M)
        deleted = [parameters for parameters, is_deleted in constructors if is_deleted]
        kinds = {each[0].strip() or each[1] for each in KEPT.findall(body)}
        found += [(name, kind) for kind in sorted(kinds) if not refuses(deleted, kind)
                  and any(takes(parameters, kind) for parameters, is_deleted in constructors if not is_deleted)]
    return found


def careless_functions(text):
    """Functions that may return a part of what they are given."""
    functions = FUNCTION.findall(text)
    deleted = {name for name, _, is_deleted in functions if is_deleted}
    return [name for name, parameters, is_deleted in functions if not is_deleted and name not in deleted | FOREIGN
            and re.search(r"const [\w:<>]+& ", parameters)]


class Lifetimes(unittest.TestCase):
    def test_what_keeps_or_returns_a_reference_refuses_temporaries(self):
        headers = [file for folder in ("hal", "host", "node", "topology") for file in (ROOT / folder).rglob("*.h")
                   if file.parent.name != "kernels"]
        self.assertGreater(len(headers), 500)
        for file in headers:
            text = file.read_text()
            with self.subTest(file.relative_to(ROOT).as_posix()):
                self.assertEqual(careless_constructors(text) + careless_functions(text), [])

    def test_finds_what_takes_temporaries(self):
        keeper = "class A {\n public:\n  A(const B& b, int n);\n%s private:\n  const B& b_;\n};\n"
        self.assertEqual(careless_constructors(keeper % ""), [("A", "B")])
        self.assertEqual(careless_constructors(keeper % "  A(const B&&, auto&&...) = delete;\n"), [])
        view = "struct A {\n  explicit A(std::string_view text) : text_(text) {}\n%s  std::string_view text_;\n};\n"
        self.assertEqual(careless_constructors(view % ""), [("A", "std::string_view")])
        self.assertEqual(careless_constructors(view % "  explicit A(std::same_as<std::string> auto&&) = delete;\n"), [])
        function = "const B& part(const A& a, int n);\n"
        self.assertEqual(careless_functions(function), ["part"])
        self.assertEqual(careless_functions(function + "const B& part(const A&&, int) = delete;\n"), [])


if __name__ == "__main__":
    main()
