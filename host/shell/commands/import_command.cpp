#include "host/shell/commands/import_command.h"

#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <string>

#include "host/content/importer/import_file.h"

namespace mars::commands {
namespace {

constexpr const char* kAfterwards = R"(Prints at the end what was read, what was made of it, and what was not read,
such as bones and animations. More: docs/importing.md.

A glTF figure of any size, made to stand 5 units high and look forward:
  mars import figure.glb -o figure.json --height 5 --front z
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
  const std::string letter = small.starts_with('-') ? small.substr(1) : small;
  if (letter != "x" && letter != "y" && letter != "z") return "'" + word + "' is no axis: write x, y, z, -x, -y or -z";
  word = small;
  return "";
}

CLI::Option* add_axis(CLI::App& command, const char* name, std::string& axis, const char* help) {
  return command.add_option(name, axis, help)->transform(CLI::Validator(small_axis, ""))->type_name("x|y|z|-x|-y|-z");
}

void add_size(CLI::App& command, importer::ModelSize& size) {
  CLI::Option* scale = command.add_option("--scale", size.scale, "Scale factor; default: 1. Example: --scale 0.01")
                           ->check(number_from(1e-9, 1e9, "no factor: write a number from 1e-9 to 1e9"))
                           ->type_name("FACTOR");
  command
      .add_option("--height", size.height,
                  "Height of the model from its lowest point to its highest, in units; default: as in the file. "
                  "Example: --height 5.1")
      ->check(number_from(1e-6, 1e9, "no height: write a number from 1e-6 to 1e9"))
      ->excludes(scale)
      ->type_name("UNITS");
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
  command->add_option("--joint", options->joint, "Name of its first joint; default: the file's. Example: --joint body")
      ->type_name("NAME");
  add_axis(*command, "--up", options->up,
           "The file's axis that points up, z in MARS; default: y for OBJ and glTF, z for others. Example: --up -y");
  add_axis(
      *command, "--front", options->front,
      "The file's axis along which the model looks, x in MARS; z in glTF as its makers mean it; default: the file's "
      "x stays x, if it does not point up or down. Example: --front z");
  add_size(*command, options->size);
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
