#include "host/shell/commands/import_command.h"

#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <string>

#include "host/content/importer/import_file.h"

namespace mars::commands {
namespace {

constexpr const char* kAfterwards = R"(Prints at the end what was read and what was not, such as bones, animations
and textures. More: docs/model-format.md.
)";

// Refuses NaN and what is no number, too.
auto number_from(double least, double greatest, const char* what) {
  return [=](const std::string& word) {
    double number = 0;
    const bool fits = CLI::detail::lexical_cast(word, number) && number >= least && number <= greatest;
    return fits ? std::string() : "'" + word + "' is " + what;
  };
}

// Of an axis in capitals the small letter; what is wrong with others.
std::string small_axis(std::string& word) {
  const std::string small = CLI::detail::to_lower(word);
  if (small != "x" && small != "y" && small != "z") return "'" + word + "' is no axis: write x, y or z";
  word = small;
  return "";
}

}  // namespace

void add_import(CLI::App& app) {
  const auto options = std::make_shared<importer::ImportOptions>();
  CLI::App* command = app.add_subcommand("import", "Make a model file from a mesh file or a patch file");
  command
      ->add_option("FILE", options->from,
                   "A mesh (.obj, .stl, .ply, .gltf, .glb) or patch file (.bpt). Example: teapot.bpt")
      ->required();
  command->add_option("-o,--output", options->to, "The model file. Example: -o teapot.json")
      ->required()
      ->type_name("FILE");
  command->add_option("--joint", options->joint, "Name of its joint; default: the file's. Example: --joint body")
      ->type_name("NAME");
  command
      ->add_option("--up", options->up,
                   "The file's axis that points up, z in MARS; default: y for OBJ and glTF, z for "
                   "others. Example: --up y")
      ->transform(CLI::Validator(small_axis, ""))
      ->type_name("x|y|z");
  command->add_option("--scale", options->scale, "Scale factor; default: 1. Example: --scale 0.01")
      ->check(number_from(1e-9, 1e9, "no factor: write a number from 1e-9 to 1e9"))
      ->type_name("FACTOR");
  command
      ->add_option("--crease", options->crease,
                   "Edges whose faces meet at a larger angle are sharp, others smooth, instead of the file's "
                   "normals; default: its normals, else 30, for glTF 0. Example: --crease 60")
      ->check(number_from(0, 180, "no such angle: write degrees from 0 to 180"))
      ->type_name("DEGREES");
  command->add_flag("--force", options->force, "Replace a model file that is there already. Example: --force");
  command->footer(kAfterwards);
  command->callback([options] { std::cout << importer::import_model(*options); });
}

}  // namespace mars::commands
