// `mars model` on a model in memory: its options are the keys of joints, segments and materials.
#include <gtest/gtest.h>

#include <algorithm>

#include "host/cli/program.h"
#include "host/content/keys/text.h"
#include "host/editing/model_in_memory.h"
#include "host/editing/words.h"
#include "tests/host/content/document/failure_of.h"

namespace mars::editing {
namespace {

class ModelWordsTest : public testing::Test {
 protected:
  void model(std::vector<std::string> words) {
    words.insert(words.begin(), "model");
    model_.execute(std::vector<Command>{words});
  }

  // The model stays.
  std::string failure(const std::vector<std::string>& words) {
    const document::Json before = model_.json();
    const std::string text = document::failure_of([&] { model(words); });
    EXPECT_EQ(model_.json(), before);
    return text;
  }

  const document::Json& joint(std::size_t number) { return model_.json()["joints"][number]; }

  ModelInMemory model_{document::Json::object(), modeler::Model(), "dog.json", ""};
};

TEST_F(ModelWordsTest, AreTheKeysOfTheTable) {
  cli::Program mars("mars", "");
  const cli::Command app = add_model(mars, model_);
  for (const cli::Command& verb : app.commands()) {
    if (verb.name() != "new" && verb.name() != "add" && verb.name() != "set") continue;
    for (const char* object : {"joint", "segment", "material"})
      for (const keys::Key& key : keys::object(object).keys) {
        if (!key.typed) continue;
        std::string name = "--" + std::string(key.name);
        std::ranges::replace(name, '_', '-');
        EXPECT_EQ(verb.option(name).help(), keys::help_of(key, name + " "));
      }
  }
}

TEST_F(ModelWordsTest, WriteValuesAsAFileDoes) {
  model({"new",
         "--replace",
         "leg",
         "--x-axis",
         "1",
         "1",
         "0",
         "--shape",
         "rounded_box",
         "--with",
         "edge=0.1,0.2,0.3",
         "--sbb",
         "0",
         "0",
         "0",
         "1",
         "2",
         "0.30000000000000004",
         "--material",
         "fur",
         "--color",
         "1",
         "0.5",
         "0",
         "--reflection",
         "cook-torrance",
         "--roughness",
         "0.25",
         "--sides",
         "1",
         "--casts",
         "false"});
  EXPECT_EQ(joint(0).dump(),
            R"({"name":"leg","x_axis":[1,1,0],)"
            R"("segment":{"shape":"rounded_box","sbb":[[0,0,0],[1,2,0.3]],"material":"fur","edge":[0.1,0.2,0.3]}})");
  EXPECT_EQ(
      model_.json()["materials"]["fur"],
      document::Json::parse(R"({"color": [1, 0.5, 0], "roughness": 0.25, "reflection": "cook-torrance", "sides": 1,
          "casts": false})"));
}

TEST_F(ModelWordsTest, AreRefusedByTheTable) {
  model({"new", "--replace", "--shape", "box", "--material", "fur", "--exponent", "8"});
  const auto holds = [&](const std::vector<std::string>& words, const std::string& part) {
    const std::string text = failure(words);
    EXPECT_NE(text.find(part), std::string::npos) << text;
  };
  holds({"set", "--material", "fur", "--exponent", "10001"}, "exponent: is 10001 (write a number from 0 to 10000)");
  holds({"set", "--material", "fur", "--reflection", "fong"}, "did you mean 'phong'?");
  holds({"set", "--material", "fur", "--sides", "3"}, "write a number from 1 to 2");
  holds({"set", "--material", "fur", "--color", "1", "0"}, "--color: write R G B, as in --color 0.8 0.4 0.2");
  holds({"set", "--material", "fur", "--exponent", "8", "--exponent", "9"}, "--exponent is given more than once");
  holds({"set", "body", "--shape", "cone", "--with", "top=2"}, "write a number from 0 to 1");
  holds({"set", "body", "--with", "tpo=1"}, "'tpo': is no key of a shape (did you mean 'top'?)");
  holds({"set", "body", "--sbb", "0", "0", "0", "1", "1", "0"}, "has no extent along z");
  holds({"set", "body", "--shape", "spere"}, "did you mean 'sphere'?");
  holds({"set", "body", "--limits", "y", "3", "2"}, "write the lower first");
  holds({"add", "tail", "--parent", "bdoy"}, "did you mean 'body'?");
  holds({"scale", "--height", "0"}, "--height");
}

}  // namespace
}  // namespace mars::editing
