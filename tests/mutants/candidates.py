"""Finds in a C++ source the places where a mutant can be, and writes the source with mutants that a number turns on.
The sources are laid out by clang-format, so an operator with spaces on both sides takes two operands; others take one
or, if they are < and >, are brackets of a template's arguments."""

import dataclasses
import re

KINDS = {"boundary": {"<": "<=", "<=": "<", ">": ">=", ">=": ">"},
         "condition": {"==": "!=", "!=": "==", "&&": "||", "||": "&&"},
         "arithmetic": {"+": "-", "-": "+", "*": "/", "/": "*"},
         "number": {}, "removal": {}, "result": {}, "extreme": {}}
# From what binds most to what binds least.
BINDING = ["* / %", "+ -", "<< >>", "<=>", "< <= > >=", "== !=", "&", "^", "|", "&&", "||"]
LOOSENESS = {operator: number for number, operators in enumerate(BINDING) for operator in operators.split()}
STOPS = {*"; , ? : = += -= *= /= %= &= |= ^= <<= >>= return throw case else do".split()}
OPEN, CLOSE = {"(": ")", "[": "]", "{": "}", "<": ">"}, {")": "(", "]": "[", "}": "{", ">": "<"}
CONTROLS = ("if", "for", "while", "switch", "constexpr")

HIDDEN = re.compile(r'//[^\n]*|/\*.*?\*/|^[ \t]*\#(?:[^\n]*\\\n)*[^\n]*|R"(?P<end>[^(\s]*)\(.*?\)(?P=end)"'
                    r'|"(?:[^"\\\n]|\\.)*"|(?<![0-9A-Fa-f])\'(?:[^\'\\\n]|\\.)+\'', re.S | re.M)
TOKEN = re.compile(r"[A-Za-z_]\w*|\.?\d(?:[\w.']|(?<=[eE])[+-])*|::|->|\+\+|--|<=>|(?<=\s)>>(?=\s)|<<=?|>>=|(?<=\s)>="
                   r"|[<=!+\-*/%&|^]=|&&|\|\||\S")
INTEGER = re.compile(r"([\d']+)([uUlLzZ]*)")
# Statements that only print, only check or only say what is wrong, and those in which compilers need constants.
UNWANTED = re.compile(r'\b(Failure|cout|cerr|print\w*|throw|explain\w*|help|check\(|assert\(|reserve|constexpr|'
                      r'static_assert|case|using)\b|"[^"\n]* [^"\n]*"')
CALL = re.compile(r"\w+(?:(?:::|\.|->)\w+|\[\]|<>|\(\))*\(\)")
ASSIGNMENT = re.compile(r"\*?\w+(?:(?:::|\.|->)\w+|\[\]|\(\))*(?:[-+*/%&|^]|<<|>>)?=[^=].*")
BLOCK_IN_FUNCTION = re.compile(r"(if|for|while|else|do|switch|try)\b|$")
BOOL_FUNCTION = re.compile(r"\bbool [\w:]+\(\)( ?(const|override|noexcept))*$")


@dataclasses.dataclass(frozen=True)
class Mutant:
    """`changed` in place of a file's text from `begin` to `end`. `before` and `after`: the lines, without indents."""
    file: str
    line: int
    kind: str
    before: tuple = ()
    after: tuple = ()
    begin: int = 0
    end: int = 0
    changed: str = ""

    def key(self):
        return self.file, self.kind, self.before, self.after

    def place(self):
        return f"{self.file}:{self.line} {self.kind}"


class Source:
    def __init__(self, file, text):
        self.file, self.text = file, text
        # As long as before: spaces for comments and preprocessor lines, names for literals.
        self.plain = HIDDEN.sub(lambda found: re.sub(r"[^\n]", "_" if found[0][0] in "\"'R" else " ", found[0]), text)
        self.tokens = list(TOKEN.finditer(self.plain))
        self.words = [token[0] for token in self.tokens]
        self.binary = [word in LOOSENESS and self.plain[token.start() - 1:token.start()].isspace()
                       and self.plain[token.end():token.end() + 1].isspace()
                       for word, token in zip(self.words, self.tokens)]
        # match: the other bracket of each bracket. parent: the bracket around each token.
        self.match, self.parent, self.braces, around = {}, [], {}, []
        for i, word in enumerate(self.words):
            if word in CLOSE and not self.binary[i]:
                while word != ">" and around and self.words[around[-1]] == "<":
                    around.pop()
                if around and self.words[around[-1]] == CLOSE[word]:
                    self.match[i] = around.pop()
                    self.match[self.match[i]] = i
            self.parent.append(around[-1] if around else None)
            if self.opens(i):
                if word == "{":
                    self.braces[i] = self.brace_kind(i)
                around.append(i)

    def opens(self, i):
        return self.words[i] in OPEN and not self.binary[i] and self.words[i - 1] != "operator"

    def brace_kind(self, i):
        """What begins at a brace: code, a scope of declarations or a value."""
        before, head = self.words[i - 1] if i else ";", self.words[self.boundary_before(i) + 1:i]
        if before in (")", "else", "do", "try", "const", "noexcept", "override", "mutable", "]"):
            return "code"
        if {"namespace", "struct", "class", "enum", "union", "extern"} & set(head) and not {"=", "("} & set(head):
            return "scope"
        if before in (";", "{", "}", ":"):
            in_value = self.parent[i] is not None and self.braces.get(self.parent[i], "value") == "value"
            return "value" if in_value else "code"
        return "code" if re.search(r"\) -> [\w:<>&* ,]*$", " ".join(head)) else "value"

    def boundary_before(self, i):
        """The last token before the statement in which token i is, unless i is in brackets within the statement."""
        for _ in self.words:
            i -= 1
            word = self.words[i] if i >= 0 else ";"
            if word in (";", "else", "do") or self.opens(i) or (word == ":" and "case" in self.words[max(i - 4, 0):i]):
                break
            if i in self.match:
                opening, after = self.match[i], self.words[i + 1]
                if word == "}" and self.braces[opening] != "value" and after not in ")(,;.":
                    break
                if word == ")" and self.words[opening - 1] in CONTROLS and after != "{":
                    break
                i = opening
        return i

    def in_code(self, i):
        """The token or the bracket around it that is directly in a block of code; nothing outside of functions."""
        while (parent := self.parent[i]) is None or self.braces.get(parent) != "code":
            if parent is None or self.braces.get(parent) == "scope":
                return None
            i = parent
        return i

    def skeleton(self, begin, end):
        """Tokens without spaces between them, except between words, and without what is in brackets."""
        text, i = "", begin
        while i < end:
            text += " " * (text[-1:].isalnum() and self.words[i][0].isalnum()) + self.words[i]
            if self.match.get(i, -1) > i:
                i = self.match[i]
                text += self.words[i]
            i += 1
        return text

    def statement(self, i):
        """The statement in which token i is, or what controls a statement, such as `if (...)`."""
        i = self.in_code(i)
        begin = self.tokens[self.boundary_before(i) + 1].start()
        if self.words[i - 1] in CONTROLS:
            return self.text[begin:self.tokens[self.match[i]].end()]
        return self.text[begin:self.plain.find(";", self.tokens[self.match.get(i, i)].start()) + 1]

    def operands(self, i):
        """From the first token of the left operand to the last one of the right; for && and ||, of which one binds more
        than the other, all operands of both."""
        is_logic = self.words[i] in ("&&", "||")
        looseness = LOOSENESS["||"] + 1 if is_logic else LOOSENESS[self.words[i]]
        first = last = i
        while not self.ends_operand(first - 1, looseness + 1, OPEN):
            first = self.match.get(first - 1, first - 1)
        while not self.ends_operand(last + 1, looseness, CLOSE):
            last = self.match.get(last + 1, last + 1)
        return first, last

    def ends_operand(self, i, looseness, brackets):
        """Whether token i is no part of operands of an operator that binds more than those of this looseness."""
        word = self.words[i]
        if self.binary[i]:
            return LOOSENESS[word] >= looseness
        return word in STOPS or word in brackets or (word == "}" and self.braces.get(self.match.get(i)) == "code")

    def mutants(self):
        changes = [(i, self.change(i, word)) for i, word in enumerate(self.words) if self.in_code(i) is not None]
        return [self.mutant(*change) for i, change in changes if change and not UNWANTED.search(self.statement(i))]

    def change(self, i, word):
        """A mutant's kind, its first and last token, which tokens in it are replaced, and by what."""
        for kind, opposites in KINDS.items():
            if self.binary[i] and word in opposites:
                return kind, *self.operands(i), i, i, opposites[word]
        if (number := INTEGER.fullmatch(word)) and self.words[self.parent[i]] != "<":
            return "number", i, i, i, i, str(int(number[1].replace("'", "")) + 1) + number[2]
        if word in ("min", "max") and self.words[i - 2:i] == ["std", "::"]:
            call = self.match.get(i + 1, i) + 1 if self.words[i + 1] == "<" else i + 1
            if call in self.match:
                return "extreme", i - 2, self.match[call], i, i, "max" if word == "min" else "min"
        if word == ";" and self.braces.get(self.parent[i]) == "code":
            return self.removal_or_result(self.boundary_before(i) + 1, i)
        return None

    def removal_or_result(self, first, end):
        if self.words[first] != "return":
            text = self.skeleton(first, end)
            is_plain = CALL.fullmatch(text) or ASSIGNMENT.fullmatch(text)
            return ("removal", first, end, first, end, ";") if is_plain else None
        first, last, block = first + 1, end - 1, self.parent[end]
        while BLOCK_IN_FUNCTION.match(head := self.skeleton(self.boundary_before(block) + 1, block)):
            block = self.parent[block]
        value = self.text[self.tokens[first].start():self.tokens[last].end()]
        is_bool = value in ("true", "false") or BOOL_FUNCTION.search(head)
        return ("result", first, last, first, last, f"!({value})") if is_bool else None

    def mutant(self, kind, first, last, replaced, to, by):
        begin, end = self.tokens[first].start(), self.tokens[last].end()
        replaced, to = self.tokens[replaced].start(), self.tokens[to].end()
        above, below = self.text.rfind("\n", 0, replaced) + 1, (self.text + "\n").find("\n", to)
        before, after = [tuple(line.strip() for line in text.split("\n") if line.strip()) for text in
                         (self.text[above:below], self.text[above:replaced] + by + self.text[to:below])]
        changed = self.text[begin:replaced] + by + self.text[to:end]
        return Mutant(self.file, self.text.count("\n", 0, replaced) + 1, kind, before, after, begin, end, changed)


def choice(mutant, number, text):
    """What is compiled in place of the mutant's text."""
    original = text[mutant.begin:mutant.end]
    if mutant.kind == "removal":
        return f"{{ if (!::mutants::on({number})) {original} }}"
    return f"(::mutants::on({number}) ? ({mutant.changed}) : ({original}))"


def with_choices(text, numbered):
    """The text with some of its mutants, each with its number. None of them may lie in another."""
    for number, mutant in sorted(numbered.items(), key=lambda pair: -pair[1].begin):
        text = text[:mutant.begin] + choice(mutant, number, text) + text[mutant.end:]
    return '#include "tests/mutants/mutant.h"\n#line 1\n' + text
