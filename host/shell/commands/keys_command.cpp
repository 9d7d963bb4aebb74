#include "host/shell/commands/keys_command.h"

#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "hal/failure/failure.h"
#include "host/cli/command.h"
#include "host/content/document/fields.h"
#include "host/content/document/json_file.h"
#include "host/content/keys/schema.h"
#include "host/content/keys/text.h"
#include "host/content/modeler/shape_library.h"

namespace mars::commands {
namespace {

std::vector<std::string_view> names_of(std::span<const keys::Object> objects) {
  std::vector<std::string_view> names;
  for (const keys::Object& object : objects) names.push_back(object.name);
  return names;
}

std::vector<std::string_view> names_of_models() {
  std::vector<std::string_view> names = names_of(keys::model_objects());
  names.push_back("shape");
  return names;
}

std::string list() {
  return "Of a film: " + document::joined(names_of(keys::film_objects())) +
         "\nOf a model: " + document::joined(names_of_models()) +
         "\n`mars keys NAME` prints the keys of one of them.\n";
}

std::string keys_of(const std::string& name) {
  if (const keys::Object* const object = keys::find_object(name)) return keys::table_of(*object);
  std::vector<std::string_view> names = names_of(keys::film_objects());
  for (const std::string_view each : names_of_models()) names.push_back(each);
  throw Failure("is no object of film or model files", document::in_quotes(name),
                document::did_you_mean(name, names, "`mars keys` lists what they hold"));
}

std::string schema_of(const std::string& file) {
  if (file == "film") return document::laid_out(keys::film_schema());
  std::vector<std::string_view> shapes;
  for (const modeler::LibraryShape& shape : modeler::shape_library()) shapes.push_back(shape.name);
  return document::laid_out(keys::model_schema(shapes));
}

struct Words {
  std::string name, schema;
};

std::string answer(const Words& words) {
  if (!words.schema.empty()) return schema_of(words.schema);
  return words.name.empty() ? list() : keys_of(words.name);
}

}  // namespace

void add_keys(cli::Command app) {
  const auto words = std::make_shared<Words>();
  const cli::Command command = app.add_command("keys", "Print the keys of film and model files");
  const cli::Option name =
      command.add("NAME", words->name, "Film, light, material ...; default: list these names. Example: light");
  command
      .add("--schema", words->schema,
           "Print the JSON Schema of such files instead, for editors. Example: --schema film")
      .type("film|model")
      .one_of({"film", "model"})
      .excludes(name);
  command.runs([words] { std::cout << answer(*words); });
}

}  // namespace mars::commands
