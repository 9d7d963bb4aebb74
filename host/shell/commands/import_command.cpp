#include "host/shell/commands/import_command.h"

#include <algorithm>
#include <cctype>
#include <iostream>
#include <memory>
#include <string>

#include "hal/failure/failure.h"
#include "host/cli/command.h"
#include "host/content/document/text.h"
#include "host/content/importer/import_file.h"

namespace mars::commands {
namespace {

constexpr const char* kAfterImportHelp = R"(Prints what it read from the file, what it made, and what it left out. More:
docs/importing.md, docs/motions.md.

Names the limbs of figures, which then walk, sit and wave. Where it finds others
than it should:
  mars model figure.json set JOINT --limb left.knee

For example, scale a glTF figure to 5 units, and make it look forward:
  mars import figure.glb -o figure.json --height 5 --front z

The same figure with one of its animations, its camera and lights, as a film:
  mars import figure.glb -o walk.json --as film --animation Walk --front z

A captured walk as a film, of a figure as tall as a man of the library:
  mars import walk.bvh -o walk.json --height 5.1
)";

// Refuses NaN and what is no number, too.
auto number_from(double least, double greatest, const char* what) {
  return [=](const std::string& word) {
    const auto number = document::number_in<double>(word);
    const bool fits = number && *number >= least && *number <= greatest;
    return fits ? std::string() : "'" + word + "' is " + what;
  };
}

// In capitals, too.
std::string read_axis(const std::string& word) {
  std::string small = word;
  std::ranges::transform(small, small.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const std::string letter = small.starts_with('-') ? small.substr(1) : small;
  if (letter != "x" && letter != "y" && letter != "z")
    throw Failure("'" + word + "' is no axis: write x, y, z, -x, -y or -z", "", "");
  return small;
}

void add_axis(cli::Command command, const char* name, std::string& axis, const char* help) {
  command
      .add_read(
          name, [&axis](const std::string& word) { axis = read_axis(word); }, help)
      .type("x|y|z|-x|-y|-z");
}

void add_size(cli::Command command, importer::ModelSize& size) {
  const cli::Option scale = command.add("--scale", size.scale, "Scale factor; default: 1. Example: --scale 0.01")
                                .check(number_from(1e-9, 1e9, "no factor: write a number from 1e-9 to 1e9"))
                                .type("FACTOR");
  command
      .add("--height", size.height,
           "Height of the model from its lowest point to its highest, in units; default: as in the file. "
           "Example: --height 5.1")
      .check(number_from(1e-6, 1e9, "no height: write a number from 1e-6 to 1e9"))
      .excludes(scale)
      .type("UNITS");
}

void add_motion(cli::Command command, importer::ImportOptions& options) {
  command.add_choice(
      "--as", {"model", "film"},
      [&options](std::size_t number) {
        options.as = number == 0 ? importer::ImportAs::model : importer::ImportAs::film;
      },
      "What to make, of .gltf, .glb, .fbx and .dae either; default: a film of .bvh and .amc files, a model of others. "
      "Example: "
      "--as film");
  command
      .add(
          "--rate", options.rate,
          "The film's frames per second; default: the file's, or where these are more than 30 and a multiple of 24, 25 "
          "or 30, the first such; of glTF, which has none, those that its times fit, else 24. Example: --rate 60")
      .check(number_from(0.001, 1000, "no rate: write a number from 0.001 to 1000"))
      .type("FRAMES");
  command
      .add("--file-rate", options.file_rate,
           "The motion's frames per second, instead of the file's; default for .amc, which has none: 120. "
           "Example: --file-rate 60")
      .check(number_from(0.001, 1000, "no rate: write a number from 0.001 to 1000"))
      .type("FRAMES");
  command
      .add("--animation", options.animation,
           "The animation of a scene that a film shows; default: the file's first. Example: --animation Walk")
      .type("NAME");
  command.add_choice(
      "--motion", {"keys", "matrices"},
      [&options](std::size_t number) {
        options.motion = number == 0 ? importer::ImportMotion::keys : importer::ImportMotion::matrices;
      },
      "What moves the actor of a film of a scene: keys, which people can change, but joints only turn; or matrices, as "
      "in "
      "the file; default: keys if they show all of the motion. Example: --motion keys");
  command
      .add("--skeleton", options.skeleton,
           "The .asf file of an .amc; default: beside it, the one whose name begins the motion's. Example: --skeleton "
           "02.asf")
      .type("FILE");
}

}  // namespace

void add_import(cli::Command app) {
  const auto options = std::make_shared<importer::ImportOptions>();
  const auto files = std::make_shared<std::vector<std::string>>();
  const cli::Command command =
      app.add_command("import", "Make a model or a film from a mesh, a motion or a patch file of another program");
  command
      .add("FILE", *files,
           "A mesh or scene (.obj, .stl, .ply, .gltf, .glb, .vrm, .fbx, .dae), a motion (.bvh, .amc), a skeleton "
           "(.asf) or "
           "patches (.bpt, .pov, .rib); "
           "after an .amc further ones, which follow it. Example: teapot.bpt")
      .required();
  command.add("-o,--output", options->to, "The model or film file. Example: -o teapot.json").required().type("FILE");
  command.add("--joint", options->joint, "Name of its first joint; default: the file's. Example: --joint body")
      .type("NAME");
  add_motion(command, *options);
  add_axis(command, "--up", options->up,
           "The file's axis that points up; it becomes z. Default: z for STL, PLY and .bpt, y for others. Example: "
           "--up -y");
  add_axis(command, "--front", options->front,
           "The file's axis along which the model looks; it becomes x. Default: of a model with limbs, the way they "
           "look; z for motions; else, and of films, the file's x, if it does not point up or down. Example: --front "
           "z");
  add_size(command, options->size);
  command
      .add("--crease", options->crease,
           "Make edges sharp whose faces meet at a larger angle, and all others smooth, instead of using the file's "
           "normals; default: the file's normals; without them 30, in glTF 0. Example: --crease 60")
      .check(number_from(0, 180, "no such angle: write degrees from 0 to 180"))
      .type("DEGREES");
  command.add_flag("--force", options->force, "Replace a model file that is there already. Example: --force");
  command.footer(kAfterImportHelp);
  command.runs([options, files] {
    options->from = files->front();
    options->more.assign(files->begin() + 1, files->end());
    std::cout << importer::import_model(*options);
  });
}

}  // namespace mars::commands
