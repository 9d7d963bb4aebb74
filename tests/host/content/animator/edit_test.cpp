// Keys put into a film file's JSON: what stands there afterwards, word for word.
#include "host/content/animator/keys/edit.h"

#include <gtest/gtest.h>

#include "host/content/animator/reading/read_film.h"
#include "tests/host/content/document/failure_of.h"

namespace mars::animator {
namespace {

document::Json film_with(const std::string& actor) {
  return document::Json::parse(R"({"frames": 20, "camera": {"eye": [0, -9, 2]},
    "models": {"arm": {"joints": [{"name": "a"}, {"name": "b", "parent": "a", "limits": {"y": [-10, 90]}}]}},
    "actors": [{"name": "other", "model": "arm"}, )" +
                               actor + "]}");
}

// The actor "it" with these members beside name and model, after the keys were put.
document::Json after(const std::string& members, const std::vector<ActorKey>& keys) {
  document::Json film = film_with(R"({"name": "it", "model": "arm")" + members + "}");
  put_keys(film, "it", keys);
  const document::Document document(document::laid_out(film), "f.json");
  read_film(document.root(), {});  // what stands there is a film
  EXPECT_EQ(film["actors"][0].dump(), R"({"name":"other","model":"arm"})");
  document::Json actor = film["actors"][1];
  actor.erase("name");
  actor.erase("model");
  return actor;
}

TEST(PutKeys, AnActorWithoutKeysGetsThem) {
  ActorKey late{18, glm::dvec3(1, 2.5, -0.0), {}, {{"b", {0, 45, 0}}}, {}};
  ActorKey early{6, {}, glm::dvec3(0, 0, 90), {}, Ease{0.42, 0, 0.58, 1}};
  EXPECT_EQ(after("", {late, early}).dump(), R"({"keys":[{"frame":6,"turn":[0,0,90],"ease":"both"},)"
                                             R"({"frame":18,"place":[1,2.5,0],"pose":{"b":[0,45,0]}}]})");
}

TEST(PutKeys, ValuesOfAFrameAreReplacedOthersStay) {
  const std::string before = R"(, "keys": [{"frame": 3, "place": [1, 1, 1]},
    {"frame": 5, "place": [2, 2, 2], "pose": {"a": [1, 2, 3], "b": [0, 4, 0]}, "ease": "in"}])";
  EXPECT_EQ(after(before, {{5, glm::dvec3(7, 8, 9), glm::dvec3(0, 0, 5), {{"b", {0, 80, 0}}}, {}}}).dump(),
            R"({"keys":[{"frame":3,"place":[1,1,1]},)"
            R"({"frame":5,"place":[7,8,9],"turn":{"value":[0,0,5],"ease":"linear"},)"
            R"("pose":{"a":[1,2,3],"b":[0,80,0]},"ease":"in"}]})")
      << "the key's ease is not that of what it did not have";
}

TEST(PutKeys, AnEaseReplacesTheOneOfItsFrame) {
  const std::string before = R"(, "keys": [{"frame": 5, "turn": [0, 0, 2], "ease": "in"}])";
  EXPECT_EQ(after(before, {{5, {}, glm::dvec3(0, 0, 2), {}, kLinear}}).dump(),
            R"({"keys":[{"frame":5,"turn":[0,0,2],"ease":"linear"}]})");
  EXPECT_EQ(after(before, {{5, {}, glm::dvec3(0, 0, 3), {}, Ease{0.5, -0.25, 1, 1}}})["keys"][0]["ease"].dump(),
            "[0.5,-0.25,1,1]");
}

TEST(PutKeys, StillValuesOfWhatIsKeyedBecomeKeysOfFrame0) {
  const std::string still = R"(, "place": [1, 0, 0], "turn": [0, 0, 3], "pose": {"a": [1, 0, 0], "b": [0, 5, 0]})";
  EXPECT_EQ(after(still, {{9, glm::dvec3(2, 0, 0), {}, {{"b", {0, 6, 0}}}, {}}}).dump(),
            R"({"turn":[0,0,3],"pose":{"a":[1,0,0]},"keys":[{"frame":0,"place":[1,0,0],"pose":{"b":[0,5,0]}},)"
            R"({"frame":9,"place":[2,0,0],"pose":{"b":[0,6,0]}}]})");
}

TEST(PutKeys, AKeyOfFrame0TakesTheStillValuesPlace) {
  const std::string still = R"(, "place": [1, 0, 0], "pose": {"b": [0, 5, 0]})";
  EXPECT_EQ(after(still, {{0, glm::dvec3(2, 0, 0), {}, {{"b", {0, 6, 0}}}, {}}}).dump(),
            R"({"keys":[{"frame":0,"place":[2,0,0],"pose":{"b":[0,6,0]}}]})");
}

TEST(PutKeys, WhatCannotBeKeyedIsToldAndTheFilmStays) {
  document::Json film = film_with(R"({"name": "it", "model": "arm", "matrices": []})");
  const document::Json before = film;
  const std::vector<ActorKey> keys = {{3, glm::dvec3(1, 1, 1), {}, {}, {}}};
  EXPECT_TRUE(
      document::holds(document::failure_of([&] { put_keys(film, "it", keys); }), "actor 'it': is moved by matrices"));
  EXPECT_TRUE(document::holds(document::failure_of([&] { put_keys(film, "othre", keys); }), "did you mean 'other'?"));
  EXPECT_EQ(film, before);
}

TEST(Rounded, KeepsNineDigits) {
  EXPECT_EQ(rounded(1.0 / 3), 0.333333333);
  EXPECT_EQ(rounded(-123456.7891234), -123456.789);
  EXPECT_EQ(rounded(6e-17), 0);
  EXPECT_EQ(rounded(0.1 + 0.2), 0.3);
}

}  // namespace
}  // namespace mars::animator
