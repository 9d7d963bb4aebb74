// The table is whole: types that there are, defaults and examples that their own schema takes.
#include "host/content/keys/key.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "host/content/keys/material_keys.h"
#include "host/content/keys/text.h"

namespace mars::keys {
namespace {

template <typename Check>
void for_each_key(Check check) {
  for (const auto objects : {film_objects(), model_objects()})
    for (const Object& object : objects)
      for (const Key& key : object.keys) check(object, key, std::string(object.name) + "." + std::string(key.name));
}

bool is_known(std::string_view type) {
  if (type.front() == '[' || type.front() == '{') return is_known(type.substr(1, type.size() - 2));
  const std::set<std::string_view> plain{"number", "whole", "choice", "text", "file", "flag"};
  return plain.contains(type) || find_type(type) != nullptr || find_object(type) != nullptr;
}

TEST(Keys, HaveTypesThatThereAre) {
  for_each_key([](const Object&, const Key& key, const std::string& name) {
    EXPECT_TRUE(is_known(key.type)) << name << ": " << key.type;
    EXPECT_EQ(key.type == "choice", !key.choices.empty()) << name;
  });
}

TEST(Keys, SayWhatTheyMeanAndWhatHoldsWithoutThem) {
  for_each_key([](const Object& object, const Key& key, const std::string& name) {
    EXPECT_FALSE(key.meaning.empty()) << name;
    if (key.required || key.name == "eye" || object.name.ends_with("_key")) return;
    const bool either = object.name == "light" || object.name == "surface";  // one of several is required
    EXPECT_TRUE(either || !default_of(key).empty()) << name;
  });
}

TEST(Keys, AreOfKindsThatTheirObjectHas) {
  for_each_key([](const Object& object, const Key& key, const std::string& name) {
    if (key.of == kEveryKind || object.name.ends_with("_key")) return;
    EXPECT_NE(key.of, 0u) << name;
    EXPECT_EQ(key.of >> object.kinds.size(), 0u) << name;
  });
}

TEST(Keys, AreMeasuredForEachKind) {
  for_each_key([](const Object& object, const Key& key, const std::string& name) {
    if (key.measures.empty() || object.name.ends_with("_key")) return;
    ASSERT_EQ(key.measures.size(), object.kinds.size()) << name;
    for (unsigned kind = 0; kind < object.kinds.size(); ++kind) {
      EXPECT_GE(key.range_of(kind).lowest, key.range.lowest) << name;
      EXPECT_LE(key.range_of(kind).highest, key.range.highest) << name;
      EXPECT_LE(*key.number, key.range_of(kind).highest) << name;
    }
  });
}

// A light of each kind begins with keys that it has.
TEST(Kinds, BeginWithTheirKeys) {
  const Object& light = object("light");
  for (unsigned kind = 0; kind < light.kinds.size(); ++kind)
    for (const std::string_view word : light.kinds[kind].begins_with)
      EXPECT_TRUE(light.key(word.substr(0, word.find('='))).is_of(kind)) << word;
}

TEST(Keys, HaveDefaultsWithinTheirRanges) {
  for_each_key([](const Object&, const Key& key, const std::string& name) {
    if (!key.number) return;
    EXPECT_GE(*key.number, key.range.lowest) << name;
    EXPECT_LE(*key.number, key.range.highest) << name;
  });
}

TEST(Keys, OfAnObjectHaveNamesOfTheirOwn) {
  for (const auto objects : {film_objects(), model_objects()})
    for (const Object& object : objects)
      EXPECT_EQ(std::set(object.names.begin(), object.names.end()).size(), object.keys.size()) << object.name;
}

TEST(Keys, OfAMaterialLieInItsStruct) {
  for (const MaterialNumber& number : kMaterialNumbers) {
    EXPECT_NE(object("material").find(number.key.name), nullptr) << number.key.name;
    EXPECT_NE(object("material_key").find(number.key.name), nullptr) << number.key.name;
    EXPECT_GE(number.slider.lowest, number.key.range.lowest) << number.key.name;
    EXPECT_LE(number.slider.highest, number.key.range.highest) << number.key.name;
  }
}

TEST(Keys, OfAMaterialThatAreTrueOrFalseLieInItsStruct) {
  for (const MaterialFlag& flag : kMaterialFlags) {
    EXPECT_EQ(object("material").key(flag.key.name).type, "flag");
    EXPECT_EQ(object("film_material").key(flag.key.name).type, "flag");
    EXPECT_EQ(object("material_key").find(flag.key.name), nullptr) << flag.key.name;
  }
}

TEST(Text, OffersBothValuesOfAFlag) {
  const std::vector<std::string> forms = typed_forms(object("light"));
  for (const char* form : {"shadow=true", "shadow=false", "size="})
    EXPECT_EQ(std::ranges::count(forms, form), 1) << form;
  EXPECT_EQ(std::ranges::count(forms, "shadow="), 0);
}

TEST(Text, OfAKeyIsAHelpWithAnExample) {
  EXPECT_EQ(help_of(kMaterialNumbers[0].key, "--ambient "),
            "Share of the film's ambient light that it reflects (0 to 10). Example: --ambient 0.1");
  EXPECT_EQ(range_of(object("camera").key("fov")), "0.01 to 179 degrees");
  EXPECT_EQ(names_of(object("light")), "direction, place, at, cone, reach, color, intensity, shadow or size");
}

}  // namespace
}  // namespace mars::keys
