// Two types of one full name in two files break C++'s one definition rule, and no linker says so: one file's inline
// members then serve the other's objects. Types in anonymous namespaces and in functions are their file's own.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <optional>
#include <regex>
#include <string>
#include <vector>

#include "tests/architecture/sources.h"

namespace {

// The text without comments, literals and preprocessor lines.
std::string bare(const std::string& text) {
  static const std::regex other(R"re(//[^\n]*|/\*(?:[^*]|\*(?!/))*\*/)re"         // comments
                                R"re(|"(?:[^"\\\n]|\\.)*"|'(?:[^'\\\n]|\\.)')re"  // literals
                                R"re(|(?:^|\n)\s*#[^\n]*)re");
  std::string left;
  std::size_t at = 0;
  // Raw literals by hand, for the expression above knows none.
  for (std::size_t raw; (raw = text.find("R\"", at)) != std::string::npos;) {
    const std::size_t open = text.find('(', raw);
    const std::string end = ")" + text.substr(raw + 2, open - raw - 2) + "\"";
    left += text.substr(at, raw - at);
    at = std::min(text.find(end, open), text.size() - end.size()) + end.size();
  }
  return std::regex_replace(left + text.substr(at), other, " ");
}

struct Scope {
  enum Kind { space, type, other } kind;
  std::string name;  // empty: anonymous
};

// What a brace opens after `head`, the text since the last brace or semicolon.
Scope opened(const std::string& head) {
  static const std::regex space(R"(\s*(?:inline\s+)?namespace\s*([\w:]*)\s*)");
  static const std::regex type(R"(\s*(?:template\s*<[^{}]*>\s*)?(?:class|struct|union|enum(?:\s+class|\s+struct)?)\s+)"
                               R"((?:alignas\s*\([^)]*\)\s*)?(\w[\w:]*(?:<[^()]*>)?)\s*(?:final\s*)?(?::[^()]*)?)");
  std::smatch match;
  if (std::regex_match(head, match, space)) return {Scope::space, match[1]};
  if (std::regex_match(head, match, type)) return {Scope::type, match[1]};
  return {Scope::other, ""};
}

// The full names of the types that all files could see.
std::vector<std::string> types_of(const std::string& source) {
  const std::string text = bare(source);
  std::vector<std::string> names;
  std::vector<Scope> scopes;
  const auto full_name = [&](const std::string& name) -> std::optional<std::string> {
    std::string full;
    for (const Scope& scope : scopes) {
      if (scope.kind != Scope::space || scope.name.empty()) return std::nullopt;
      full += scope.name + "::";
    }
    return full + name;
  };
  std::size_t head = 0;
  for (std::size_t at = 0; (at = text.find_first_of("{};", at)) != std::string::npos; head = ++at) {
    if (text[at] == '}' && !scopes.empty()) scopes.pop_back();
    if (text[at] != '{') continue;
    const Scope scope = opened(text.substr(head, at - head));
    if (scope.kind == Scope::type)
      if (const auto name = full_name(scope.name)) names.push_back(*name);
    scopes.push_back(scope);
  }
  return names;
}

TEST(Names, TypesAreReadFromText) {
  const std::string text = R"x(
#define IGNORED struct A {
namespace mars::host { // struct B {
struct One { struct Inner {}; int n = 2'000; };
namespace { struct Own {}; }
template <typename T> class Two final : public One { char c = '{'; const char* s = "struct C {"; };
enum class Three : int { a, b };
void f() { struct Local {}; }
struct Declared;
}  // namespace mars::host
namespace mars { union Four {}; }
)x";
  EXPECT_EQ(types_of(text),
            (std::vector<std::string>{"mars::host::One", "mars::host::Two", "mars::host::Three", "mars::Four"}));
}

TEST(Names, EveryTypeHasANameOfItsOwn) {
  std::map<std::string, std::string> files;
  for (const mars::test::Source& source : mars::test::sources()) {
    if (source.path.find("/smpi_") != std::string::npos) continue;  // stands in for another file, never beside it
    for (const std::string& name : types_of(source.text)) {
      const auto [first, is_new] = files.emplace(name, source.path);
      EXPECT_TRUE(is_new) << name << " is defined in " << first->second << " and in " << source.path;
    }
  }
  EXPECT_GT(files.size(), 200u) << "nothing to scan: the test is broken";
}

}  // namespace
