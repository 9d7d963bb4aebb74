#include "host/content/document/document.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>

#include "host/content/document/fields.h"
#include "host/content/document/file.h"
#include "tests/host/content/document/failure_of.h"
#include "tests/temporary_folder.h"

namespace mars::document {
namespace {

std::string parse_failure(const std::string& json) {
  return failure_of([&] { Document(json, "a.json"); });
}

TEST(Document, ElementsKnowTheirLineAndPath) {
  const Document document("{\n  \"actors\": [\n    1,\n    {\"left knee\": [2,\n3\n]}\n  ]\n}", "a.json");
  const Element actors = *document.root().find("actors");
  EXPECT_EQ(actors.size(), 2u);
  EXPECT_EQ(actors.line(), 2u);
  auto child = actors.begin();
  EXPECT_EQ((*child).line(), 3u);
  const Element knee = *(*++child).find("left knee");
  EXPECT_EQ(knee.path(), "actors[1][\"left knee\"]");
  auto number = knee.begin();
  EXPECT_EQ((*++number).line(), 5u) << "a number before a newline belongs to its own line";
  EXPECT_EQ((*number).where(), "a.json:5: actors[1][\"left knee\"][1]");
  EXPECT_EQ((*number).number(), 3);
}

struct Malformed {
  const char* json;
  const char* reported;
};

class MalformedDocument : public testing::TestWithParam<Malformed> {};

TEST_P(MalformedDocument, IsOneClearError) {
  const std::string failure = parse_failure(GetParam().json);
  EXPECT_TRUE(holds(failure, "a.json")) << failure;
  EXPECT_TRUE(holds(failure, GetParam().reported)) << failure;
}

INSTANTIATE_TEST_SUITE_P(
    Table, MalformedDocument,
    testing::Values(
        Malformed{"", "is empty"}, Malformed{" \n\t", "is empty"},
        Malformed{"{", "ends before its last bracket (the file may be cut short)"},
        Malformed{"[1,2", "ends before its last bracket"}, Malformed{"{\"a\": {}", "before its last bracket"},
        Malformed{"{\"a\": tr\n", "ends before its last bracket"},
        Malformed{"{\"a\": 1.", "ends before its last bracket"},
        Malformed{"{\"a\": \"x\\", "ends before its last bracket"},
        Malformed{"{\"a\": \"x\xc3", "ends before its last bracket"}, Malformed{"{\"a\": \"x}", "ends within a text"},
        Malformed{"{\"frames\": 3}}", "goes on after its end (take out what follows the last bracket)"},
        Malformed{"{\"frames\": 1.}", "frames: is not JSON: a number is not complete"},
        Malformed{"{\n\"a\": tru}", "a.json:2"}, Malformed{"{\"a\": NaN}", "not JSON"},
        Malformed{"{\"a\": 1e999}", "a number is too large"}, Malformed{"{\"a\": -Infinity}", "not JSON"},
        Malformed{"// hello\n{}", "no comments"}, Malformed{"{\"a\": 1,}", "trailing commas"},
        Malformed{"{} {}", "not JSON"}, Malformed{"\xff\xfe{}", "not JSON"},
        Malformed{"{\"a\": 1,\n\"b\": 2,\n\"a\": 3}", "a.json:3: a: stands twice"},
        Malformed{"[1, {\"k\": [{\"a\": 1, \"a\": 2}]}]", "[1].k[0].a: stands twice"},
        Malformed{"{\"a\\u0000b\": 1}", "a.json:1: has a key with a control character"},
        Malformed{"{\"k\": {\n\"a\\u0001\": 1}}", "a.json:2: k: has a key with a control character"},
        Malformed{"{\"k\": [1,\n\"a\\u0001\"]}", "a.json:2: k[1]: has a text with a control character"},
        Malformed{"{\"k\": {\"a\": \"x\ty\"}}", "a.json:1: k.a: is not JSON: a text holds the end of a line"}));

TEST(Document, ALongTextIsToldWithItsPlaceAndALongKeyShortened) {
  const std::string longest(5000, 'x');
  EXPECT_EQ(parse_failure("{\"a\": [{\"name\": \"" + longest + "\"}]}"),
            "a.json:1: a[0].name: has a text of 5000 bytes (at most 4096 bytes)");
  EXPECT_TRUE(holds(parse_failure("{\"a\": {\"" + longest + "\": 1}}"), "a.json:1: a: has a key of 5000 bytes"));
  const Document document("{\"" + longest.substr(0, 3000) + "\": 1}", "a.json");
  EXPECT_EQ((*document.root().begin()).path(), longest.substr(0, 80) + "...");
  EXPECT_EQ(shortened(longest.substr(0, 79) + "\xc3\xa4y"), longest.substr(0, 79) + "...");
}

TEST(Document, RefusesDeepNestingAndBinaryFiles) {
  EXPECT_TRUE(holds(parse_failure(std::string(100'000, '[')), "64 deep"));
  EXPECT_EQ(parse_failure(std::string(64, '[') + std::string(64, ']')), "");
  EXPECT_TRUE(holds(parse_failure(std::string("\x7f"
                                              "ELF\0\0",
                                              6)),
                    "binary"));
  EXPECT_TRUE(holds(parse_failure("[\"" + std::string(5000, 'x') + "\"]"), "5000 bytes"));
}

TEST(Document, FindsADoubleKeyAmongManyQuickly) {
  std::string json = "{";
  for (int i = 0; i < 200'000; ++i) json += "\"key" + std::to_string(i) + "\": 0,\n";
  EXPECT_EQ(parse_failure(json + "\"last\": 1}"), "");
  EXPECT_TRUE(holds(parse_failure(json + "\"key77\": 1}"), "first in line 78"));
}

constexpr std::string_view kNames[] = {"place", "limits", "segment"};
constexpr Keys kTestKeys{"thing", kNames};

std::string thing_failure(const std::string& json) {
  return failure_of([&] {
    const Document document(json, "a.json");
    const Fields fields(document.root(), kTestKeys);
    if (const auto place = fields.find("place")) read_vector(*place);
    fields.count("limits", 0, 1, 9);
    constexpr std::string_view shapes[] = {"sphere", "torus"};
    fields.choice("segment", 0, shapes);
    fields.required("place");
  });
}

TEST(Fields, TellWhatIsWrongAndWhatWouldBeRight) {
  EXPECT_EQ(thing_failure("{\"place\": [1, 2, 3], \"limits\": 3, \"segment\": \"torus\"}"), "");
  EXPECT_TRUE(holds(thing_failure("{\"palce\": 1}"), "did you mean 'place'?"));
  EXPECT_TRUE(holds(thing_failure("{\"zzzzzz\": 1}"), "its keys are: place, limits, segment"));
  EXPECT_TRUE(holds(thing_failure("{}"), "has no 'place'"));
  EXPECT_EQ(thing_failure("[]"), "a.json:1: is a list, not a thing (write it as {\"place\": ...})");
  EXPECT_TRUE(holds(thing_failure("{\"place\": [1, 2]}"), "has 2 items"));
  EXPECT_TRUE(holds(thing_failure("{\"place\": [1, 2, 1e308]}"), "place[2]: is 1e+308"));
  EXPECT_TRUE(holds(thing_failure("{\"place\": [1, 2, \"x\"]}"), "is a text, not a number"));
  EXPECT_TRUE(holds(thing_failure("{\"limits\": 2.5}"), "whole number"));
  EXPECT_TRUE(holds(thing_failure("{\"limits\": 10}"), "from 1 to 9"));
  EXPECT_TRUE(holds(thing_failure("{\"segment\": \"sfere\"}"), "did you mean 'sphere'?"));
}

TEST(File, RefusesWhatIsNoFile) {
  const test::TemporaryFolder folder;
  EXPECT_TRUE(holds(failure_of([&] { read_file(folder.path()); }), "is a directory"));
  EXPECT_TRUE(holds(failure_of([&] { read_file(folder / "no-such-file.json"); }), "no such file"));
  EXPECT_TRUE(holds(failure_of([&] { read_file("/dev/zero"); }), "not a regular file"));
  const std::filesystem::path odd = folder / "odd";
  EXPECT_FALSE(read_file_if_there(odd, 4));
  ASSERT_EQ(mkfifo(odd.c_str(), 0600), 0);
  EXPECT_TRUE(holds(failure_of([&] { read_file_if_there(odd, 4); }), "odd: is not a regular file"));
  EXPECT_EQ(read_start(odd, 4), "");
  std::filesystem::remove(odd);
  std::filesystem::create_symlink(odd.filename(), odd);
  EXPECT_TRUE(holds(failure_of([&] { read_file(odd); }), "levels of symbolic links (its links lead in a circle"));
  const std::filesystem::path file = folder / "file.json";
  std::ofstream(file) << "12345";
  EXPECT_TRUE(holds(failure_of([&] { read_file(file, 4); }), "5 bytes, too many"));
  EXPECT_EQ(read_file(file, 5), "12345");
}

}  // namespace
}  // namespace mars::document
