// Files that commands change: laid out for people, written only if what reads them agrees.
#include "host/content/document/json_file.h"

#include <gtest/gtest.h>

#include <fstream>

#include "hal/failure/explain.h"
#include "hal/failure/failure.h"
#include "host/content/document/fields.h"
#include "tests/host/content/document/failure_of.h"
#include "tests/temporary_folder.h"

namespace mars::document {
namespace {

std::string content(const std::filesystem::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(JsonFile, WhatFitsStandsOnOneLine) {
  const Json json = {{"name", "lamp \"a\""}, {"place", {0.1, -2.5, 1e-9}}, {"limits", Json::object()}};
  EXPECT_EQ(laid_out(json), "{\"name\": \"lamp \\\"a\\\"\", \"place\": [0.1, -2.5, 1e-09], \"limits\": {}}\n");
}

TEST(JsonFile, WhatDoesNotFitIsIndentedAndKeepsItsOrder) {
  const std::string word(60, 'w');
  const Json json = {{"z", word}, {"a", {word, {{"k", 1}}, Json::array()}}};
  EXPECT_EQ(laid_out(json), "{\n  \"z\": \"" + word + "\",\n  \"a\": [\"" + word + "\", {\"k\": 1}, []]\n}\n");
  EXPECT_EQ(Json::parse(laid_out(json)), json);
}

TEST(JsonFile, NoLineIsLongerThanItMustBe) {
  Json json = Json::array();
  for (int i = 0; i < 60; ++i) json.push_back({{"frame", i}, {"pose", {{"knee", {0, i * 1.25, 0}}}}});
  const std::string text = laid_out({{"keys", json}});
  for (std::size_t at = 0, end; (end = text.find('\n', at)) != std::string::npos; at = end + 1)
    EXPECT_LE(end - at, 110u);
  EXPECT_EQ(Json::parse(text).at("keys"), json);
}

TEST(JsonFile, WhatIsRefusedLeavesTheFileAsItWas) {
  const test::TemporaryFolder folder;
  const auto path = folder.path() / "a.json";
  const auto accept = [](const Element&) {};
  write_json(path, {{"a", 1}}, accept);
  EXPECT_EQ(read_json(path), Json({{"a", 1}}));
  const auto refuse = [](const Element& root) { root.find("a")->refuse("is two", "write one"); };
  EXPECT_THROW(write_json(path, {{"a", 2}}, refuse), Failure);
  EXPECT_EQ(content(path), "{\"a\": 1}\n");
}

TEST(JsonFile, OnlyUtf8IsWritten) {
  const test::TemporaryFolder folder;
  const auto write = [&] { write_json(folder.path() / "a.json", {{"joint\xff", 1}}, [](const Element&) {}); };
  EXPECT_TRUE(holds(failure_of(write), "a name that was given is not UTF-8"));
}

TEST(JsonFile, AFlagIsTrueFalseOrMissing) {
  const Json object = {{"on", true}, {"off", false}, {"none", nullptr}, {"text", "yes"}};
  EXPECT_TRUE(flag_in(object, "on", false));
  EXPECT_FALSE(flag_in(object, "off", true));
  for (const char* missing : {"none", "other"}) EXPECT_TRUE(flag_in(object, missing, true));
  EXPECT_TRUE(holds(failure_of([&] { flag_in(object, "text", true); }), "'text': is neither true nor false"));
}

TEST(JsonFile, ABrokenFileIsToldWithItsLine) {
  const test::TemporaryFolder folder;
  const auto path = folder.path() / "a.json";
  std::ofstream(path) << "{\n  \"a\": 1,\n  \"a\": 2\n}\n";
  try {
    read_json(path);
    FAIL();
  } catch (const Failure& failure) {
    EXPECT_NE(reason_of(failure).find("a.json:3"), std::string::npos) << reason_of(failure);
  }
}

}  // namespace
}  // namespace mars::document
