// A number of a material that is planted in the table and in the struct alone (CMakeLists.txt) is there for all: it is
// read, refused with its range, and stands in help, schemas, tables of docs and the studio's fields. So are keys of
// lights and of films that are planted in the table, but for their readers.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "hal/failure/failure.h"
#include "host/cli/program.h"
#include "host/content/document/fields.h"
#include "host/content/keys/page_keys.h"
#include "host/content/keys/schema.h"
#include "host/content/keys/text.h"
#include "host/content/modeler/edit_material.h"
#include "host/content/modeler/material.h"
#include "host/editing/key_words.h"

namespace mars::keys {
namespace {

wire::Material read(const std::string& json) {
  const document::Document document(json, "planted.json");
  return modeler::read_material(document::Fields(document.root(), object("material")));
}

TEST(PlantedKey, IsRead) {
  EXPECT_EQ(read(R"({"planted": 0.5})").planted, 0.5f);
  EXPECT_EQ(read("{}").planted, 0.25f);
}

TEST(PlantedKey, IsRefusedWithItsRange) {
  try {
    read(R"({"planted": 2})");
    FAIL();
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.problem, "is 2");
    EXPECT_EQ(failure.remedy, "write a number from 0 to 1");
  }
  EXPECT_THROW(read(R"({"reflection": "metallic-roughness", "planted": 0.5})"), Failure);  // which does not use it
}

TEST(PlantedKey, IsAnOptionOfMarsModel) {
  document::Json values = document::Json::object(), material{{"exponent", 8}};
  const auto type = [&](const std::string& number) {
    cli::Program program("mars", "");
    const cli::Command set = program.add_command("set", "");
    editing::add_key_options(set, object("material"), values);
    EXPECT_EQ(set.option("--planted").help(), "Light at grazing angles (0 to 1). Example: --planted 0.25");
    program.read({"set", "--reflection", "phong", "--planted", number});
    modeler::change_material(material, values);
    return material.dump();
  };
  EXPECT_EQ(type("0.5"), R"({"exponent":8,"planted":0.5,"reflection":"phong"})");
  EXPECT_EQ(read(material.dump()).planted, 0.5f);
  EXPECT_THROW(read(type("2")), Failure);
  EXPECT_EQ(editing::values_of(std::vector<std::string>{"planted=0.5"}, object("material")).dump(),
            R"({"planted":0.5})");
}

TEST(PlantedKey, StandsInHelpSchemasDocsAndThePage) {
  EXPECT_NE(names_of(object("material")).find("planted"), std::string::npos);
  EXPECT_NE(table_of(object("material")).find("planted"), std::string::npos);
  EXPECT_NE(
      markdown_of(object("film_material")).find("| `planted` | light at grazing angles (0 to 1) | `0.25` | yes |"),
      std::string::npos);
  EXPECT_EQ(film_schema()["$defs"]["film_material"]["properties"]["planted"]["maximum"], 1);
  EXPECT_TRUE(film_schema()["$defs"]["material_key"]["properties"].contains("planted"));
  EXPECT_EQ(model_schema({})["$defs"]["material"]["properties"]["planted"]["default"], 0.25);
  EXPECT_EQ(keys_of_pages()["material"]["planted"]["slider"], nlohmann::ordered_json({0, 1}));
}

TEST(PlantedKey, OfALightIsThePagesWithTheKindsThatHaveIt) {
  const nlohmann::ordered_json keys = keys_of_pages();
  EXPECT_EQ(keys["light"]["softness"], nlohmann::ordered_json::parse(R"({"type": "number",
      "meaning": "how soft the edge of its cone is", "least": 0.0, "most": 1.0, "default": 0.5, "keyed": true,
      "of": ["spot"]})"));
  EXPECT_TRUE(film_schema()["$defs"]["light_key"]["properties"].contains("softness"));
  EXPECT_NE(names_of(object("light")).find("softness"), std::string::npos);
  EXPECT_EQ(keys["kinds"]["light"][2], nlohmann::ordered_json::parse(R"({"name": "spot", "label": "Spot",
      "begins_with": ["place=0,-4,5", "at=0,0,1"]})"));
}

TEST(MeasuredKey, HasRangeAndUnitOfEachKindOnThePage) {
  EXPECT_EQ(keys_of_pages()["light"]["size"]["measures"],
            nlohmann::ordered_json::parse(R"({"directional": {"least": 0.0, "most": 90.0, "unit": "degrees"},
                "point": {"least": 0.0, "most": 1e9}, "spot": {"least": 0.0, "most": 1e9}})"));
}

TEST(Flag, IsTypedAsTrueOrFalse) {
  const auto typed = [](const std::string& word) {
    return editing::values_of(std::vector<std::string>{"shadow=" + word}, object("light"))["shadow"];
  };
  EXPECT_EQ(typed("true"), true);
  EXPECT_EQ(typed("false"), false);
  EXPECT_EQ(typed("yes"), "yes") << "which readers refuse";
  document::Json values = document::Json::object();
  cli::Program program("mars", "");
  const cli::Command set = program.add_command("set", "");
  editing::add_key_options(set, object("material"), values);
  program.read({"set", "--casts", "false", "--receives", "true"});
  EXPECT_EQ(values.dump(), R"({"casts":false,"receives":true})");
  EXPECT_EQ(read(values.dump()).casts, 0u);
}

TEST(PlantedKey, OfAFilmIsThePages) {
  EXPECT_EQ(keys_of_pages()["film"]["grain"],
            nlohmann::ordered_json::parse(R"({"type": "number", "meaning": "noise of the picture", "least": 0.0,
                "most": 1.0, "default": 0.0, "rare": true})"));
}

// What a type's values are comes with it.
TEST(PagesKeys, HaveChoicesAndPartsOfTheirTypes) {
  const nlohmann::ordered_json keys = keys_of_pages();
  EXPECT_EQ(keys["film"]["samples"]["choices"], nlohmann::ordered_json({1, 2, 4, 8, 16}));
  EXPECT_EQ(keys["film"]["size"]["parts"], nlohmann::ordered_json({"width", "height"}));
  EXPECT_EQ(keys["light"]["cone"]["most"], 180);
  EXPECT_EQ(keys["light"]["reach"]["of"], nlohmann::ordered_json({"point", "spot"}));
  EXPECT_EQ(keys["light"]["reach"]["without"], "the same at all distances");
  EXPECT_EQ(keys["camera"]["exposure"]["of"], nlohmann::ordered_json({"linear"}));
}

}  // namespace
}  // namespace mars::keys
