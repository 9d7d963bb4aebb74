// The published schemas take what the table of keys shows, and every example is read and compiled.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "host/content/animator/reading/read_film.h"
#include "host/content/document/file.h"
#include "host/content/document/json_file.h"
#include "host/content/keys/key.h"
#include "host/content/film/compile.h"
#include "host/content/modeler/read_model.h"

namespace mars::film {
namespace {

namespace fs = std::filesystem;

// Whether a value is as a schema says; of JSON Schema what ours use for values of keys.
class Schemas {
 public:
  bool takes(document::Json schema, const document::Json& value) const {
    schema = resolved(schema);
    if (schema.contains("anyOf"))
      return std::ranges::any_of(schema["anyOf"], [&](const document::Json& each) { return takes(each, value); });
    if (schema.contains("const")) return value == schema["const"];
    if (schema.contains("enum")) return std::ranges::count(schema["enum"], value) > 0;
    const std::string type = schema.value("type", "");
    if (type == "number" || type == "integer")
      return value.is_number() && value >= schema.value("minimum", value) && value <= schema.value("maximum", value);
    if (type == "array")
      return value.is_array() && value.size() >= schema.value("minItems", std::size_t{0}) &&
             value.size() <= schema.value("maxItems", value.size()) &&
             std::ranges::all_of(value, [&](const document::Json& each) { return takes(schema["items"], each); });
    if (type == "string") return value.is_string();
    if (type == "boolean") return value.is_boolean();
    if (type == "null") return value.is_null();
    return type == "object" && value.is_object() && takes_object(schema, value);
  }

  document::Json of(const keys::Object& object, const keys::Key& key) const {
    for (const document::Json* file : {&film_, &model_}) {
      if ((*file)["$id"] == std::string(object.name) + ".schema.json") return (*file)["properties"][key.name];
      if ((*file)["$defs"].contains(object.name)) return (*file)["$defs"][object.name]["properties"][key.name];
    }
    return {};
  }

 private:
  static document::Json read(const char* name) {
    return document::read_json(fs::path(MARS_SOURCE_DIR) / "docs/schema" / name);
  }

  document::Json resolved(const document::Json& schema) const {
    if (!schema.contains("$ref")) return schema;
    const std::string name = schema["$ref"];
    if (name == "model.schema.json") return model_;
    const std::string definition = name.substr(name.rfind('/') + 1);
    return resolved((film_["$defs"].contains(definition) ? film_ : model_)["$defs"][definition]);
  }

  bool takes_object(const document::Json& schema, const document::Json& value) const {
    for (const document::Json& needed : schema.value("required", document::Json::array()))
      if (!value.contains(needed.get<std::string>())) return false;
    const document::Json properties = schema.value("properties", document::Json::object()),
                         others = schema.value("additionalProperties", document::Json());
    return std::ranges::all_of(value.items(), [&](const auto& item) {
      if (properties.contains(item.key())) return takes(properties[item.key()], item.value());
      return others.is_object() && takes(others, item.value());
    });
  }

  const document::Json film_ = read("film.schema.json"), model_ = read("model.schema.json");
};

TEST(Schema, TakesTheExamplesThatMessagesShow) {
  const Schemas schemas;
  for (const auto objects : {keys::film_objects(), keys::model_objects()})
    for (const keys::Object& object : objects)
      for (const keys::Key& key : object.keys)
        for (const std::string_view text : {key.example, key.json})
          if (!text.empty()) {
            EXPECT_TRUE(schemas.takes(schemas.of(object, key), document::Json::parse(text)))
                << object.name << "." << key.name << ": " << text;
          }
}

TEST(Schema, TypesTakeTheirExamples) {
  const Schemas schemas;
  for (const auto types : {keys::film_types(), keys::model_types()})
    for (const keys::Type& type : types)
      if (!type.example.empty()) {
        EXPECT_TRUE(schemas.takes({{"$ref", "#/$defs/" + std::string(type.name)}}, document::Json::parse(type.example)))
            << type.name;
      }
}

std::vector<fs::path> json_files(const char* folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(fs::path(MARS_SOURCE_DIR) / folder))
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  EXPECT_FALSE(files.empty());
  return files;
}

TEST(Examples, AllCompile) {
  for (const fs::path& path : json_files("examples")) {
    const CompiledFilm film = load_film(path);
    EXPECT_NO_THROW(wire::PackedFilm(film.block(), path.string())) << path;
    EXPECT_GT(film.view().patch_instances(), 0u) << path;
    EXPECT_LT(fs::file_size(path), 200'000u) << path;
  }
  for (const fs::path& path : json_files("examples/models"))
    EXPECT_FALSE(modeler::load_model(path).joints.empty()) << path;
}

// Five bodies of one man's segments: their patches are stored as often as his.
TEST(Examples, FiguresOfOtherProportionsShareTheirShapes) {
  const fs::path folder = fs::path(MARS_SOURCE_DIR) / "examples";
  const CompiledFilm five = load_film(folder / "bodies.json");
  document::Json json = document::read_json(folder / "bodies.json");
  document::Json& actors = json["actors"];
  ASSERT_EQ(actors.size(), 7u);
  const auto other = [](const document::Json& actor) {
    return actor["name"] != "man" && actor["name"] != "floor" && actor["name"] != "tiles";
  };
  actors.erase(std::remove_if(actors.begin(), actors.end(), other), actors.end());
  ASSERT_EQ(actors.size(), 3u);
  const document::Document document(json.dump(), (folder / "one.json").string());
  const CompiledFilm one = compile(animator::read_film(document.root(), folder));
  EXPECT_EQ(five.view().patches().size(), one.view().patches().size());
  EXPECT_EQ(five.view().shapes().size(), one.view().shapes().size());
  EXPECT_EQ(five.view().segments().size(), one.view().segments().size() + 4 * 21);
}

// The first block of JSON on a page of docs/ that begins with `first`.
std::string worked_example(const char* page, const std::string& first = "{") {
  const std::string text = document::read_file(fs::path(MARS_SOURCE_DIR) / "docs" / page);
  const std::size_t start = text.find("```json\n" + first) + 8;
  return text.substr(start, text.find("```", start) - start);
}

TEST(Examples, ThoseOfTheDocumentationAreTrue) {
  const document::Document film(worked_example("film-format.md"), "film-format.md");
  EXPECT_EQ(compile(animator::read_film(film.root(), ".")).view().segments().size(), 2u);
  const document::Document model(worked_example("model-format.md"), "model-format.md");
  EXPECT_EQ(modeler::read_model(model.root()).joints.size(), 3u);
  const document::Document sail(R"({"joints": [{"name": "mast", "segment": {"shape": "sail"}}], )" +
                                    worked_example("shapes.md", "\"shapes\"") + "}",
                                "shapes.md");
  EXPECT_EQ(modeler::read_model(sail.root()).shapes[0].patches.size(), 1u);
}

TEST(Examples, MeasuringScenesHaveTheirTriangles) {
  const auto triangles = [](const char* name) {
    const CompiledFilm film = load_film(fs::path(MARS_SOURCE_DIR) / "examples" / name);
    const std::uint64_t dice = film.view().settings().dice;
    return film.view().patch_instances() * 2 * dice * dice;
  };
  EXPECT_EQ(triangles("s1.json"), 16'384u);
  EXPECT_EQ(triangles("s1m.json"), 262'144u);
  EXPECT_EQ(triangles("s2.json"), 1'638'400u);
  const CompiledFilm s3 = load_film(fs::path(MARS_SOURCE_DIR) / "examples/s3.json");
  ASSERT_EQ(s3.view().intervals().size(), 1u);
  EXPECT_EQ(s3.view().intervals()[0].moving_count, 1u);
}

TEST(Examples, TheCaterpillarHasFortyJointsAndMovesWithTheManAlone) {
  const CompiledFilm film = load_film(fs::path(MARS_SOURCE_DIR) / "examples/demo.json");
  EXPECT_EQ(modeler::load_model(fs::path(MARS_SOURCE_DIR) / "examples/models/caterpillar.json").joints.size(), 40u);
  for (const std::uint32_t segment : film.view().moving_segments(film.view().intervals()[0])) {
    const std::string_view name = film.view().name(film.view().segments()[segment]);
    EXPECT_TRUE(name.starts_with("caterpillar/") || name.starts_with("man/")) << name;
  }
}

TEST(Examples, TheManHasJointsWithLimits) {
  const modeler::Model man = modeler::load_model(fs::path(MARS_SOURCE_DIR) / "examples/models/human.json");
  int turning = 0;
  for (const modeler::Joint& joint : man.joints) {
    turning += joint.freedoms() > 0;
    for (const modeler::Limits& limits : joint.limits) EXPECT_LE(limits.upper - limits.lower, 225) << joint.name;
  }
  EXPECT_GE(turning, 16);
}

}  // namespace
}  // namespace mars::film
