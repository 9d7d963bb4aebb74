// The files that films and models name are all found, wherever they stand.
#include "host/content/keys/named_files.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace mars::keys {
namespace {

using Files = std::vector<std::string>;

Files named_in(const char* object_name, const char* json) {
  Files files = files_named_in(nlohmann::ordered_json::parse(json), object(object_name));
  std::ranges::sort(files);
  return files;
}

TEST(NamedFiles, OfFilmsAreSoundsModelsAndImages) {
  EXPECT_EQ(named_in("film", R"({"frames": 2, "audio": "a.wav", "curve": "none",
                "materials": {"oak": {"color": [1, 1, 1], "images": {"color": "oak.png", "normal": "bumps.png"}}},
                "models": {"man": "man.json", "own": {"from": "other.json",
                                                      "materials": {"skin": {"images": {"glow": "glow.png"}}}}},
                "actors": [{"name": "a.wav.json", "model": "man"}]})"),
            (Files{"a.wav", "bumps.png", "glow.png", "man.json", "oak.png", "other.json"}));
}

TEST(NamedFiles, OfModels) {
  EXPECT_EQ(named_in("model", R"({"from": "figure.json", "proportions": {}})"), Files{"figure.json"});
  EXPECT_EQ(named_in("model", R"({"joints": [{"name": "from", "segment": {"shape": "box"}}],
                                  "materials": {"skin": {"images": {"color": "skin.png"}}}})"),
            Files{"skin.png"});
  EXPECT_TRUE(named_in("model", R"({"joints": []})").empty());
}

TEST(NamedFiles, AreRenamed) {
  auto json = nlohmann::ordered_json::parse(
      R"({"audio": "a.wav", "models": {"man": "man.json", "own": {"joints": [{"name": "audio"}],
                                       "materials": {"skin": {"images": {"glow": "glow.png"}}}}}})");
  rename_files(json, object("film"), [](const std::string& file) { return "../" + file; });
  EXPECT_EQ(named_in("film", json.dump().c_str()), (Files{"../a.wav", "../glow.png", "../man.json"}));
  EXPECT_EQ(json["models"]["own"]["joints"][0]["name"], "audio");
}

TEST(NamedFiles, WhatHasAnotherFormIsPassedOver) {
  for (const char* json : {"[]", "3", "null", R"({"audio": 3, "models": ["man.json", 5], "materials": "oak"})",
                           R"({"audio": ["a.wav"], "materials": {"oak": {"images": "oak.png"}, "ash": 1}})"})
    EXPECT_EQ(std::ranges::count(named_in("film", json), "a.wav"), 0) << json;
}

}  // namespace
}  // namespace mars::keys
