#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "hal/failure/failure.h"
#include "host/cli/wrapped.h"
#include "host/content/document/text.h"
#include "host/content/modeler/describe.h"
#include "host/content/modeler/edit.h"
#include "host/content/modeler/edit_shapes.h"
#include "host/content/modeler/figure_library.h"
#include "host/content/modeler/mirror.h"
#include "host/content/modeler/proportions.h"
#include "host/content/modeler/review.h"
#include "host/content/modeler/scale_model.h"
#include "host/content/modeler/shape_library.h"
#include "host/editing/key_words.h"
#include "host/editing/words.h"

namespace mars::editing {
namespace {

constexpr const char* kNewFigureExample = R"(A figure from nothing:
  mars model dog.json new --shape ellipsoid --sbb -0.6 -0.2 -0.2 0.6 0.2 0.2
  mars model dog.json add leg --parent body --place 0.4 0.1 -0.1 \
      --shape capsule --sbb -0.06 -0.06 -0.5 0.06 0.06 0.06 --limits y -60 60
  mars model dog.json show
A file is changed whole or not at all. docs/modeling.md goes on from here.
)";

// What a person typed after any of the commands; what was not typed is empty.
struct ModelWords {
  EditedModel& model;
  std::string joint{}, from{}, figure{}, side{};
  modeler::JointChange change{};
  document::Json material = document::Json::object();  // values of its keys
  std::vector<double> factors{}, to{};
  std::vector<std::size_t> at{};
  std::size_t patch = 0;
  std::vector<std::tuple<std::string, double, double>> limits{};
  std::vector<std::string> options{}, joints{}, branches{};
  std::optional<double> height{};
  bool fixed = false, free = false, branch = false, no_ground = false, replace = false;
};

std::string where(const ModelWords& words) { return words.model.path().string(); }

glm::dvec3 three_numbers(const std::vector<double>& numbers) { return {numbers[0], numbers[1], numbers[2]}; }

std::string material_of(const ModelWords& words) { return words.change.segment.value("material", ""); }

modeler::JointChange change_of(const ModelWords& words) {
  modeler::JointChange change = words.change;
  if (words.fixed) change.freedom = modeler::Freedom::fixed;
  if (words.free) change.freedom = modeler::Freedom::free;
  for (const auto& [axis, lower, upper] : words.limits) change.limits.push_back({axis[0], {lower, upper}});
  change.segment.update(values_of(words.options, keys::object("shape")));
  return change;
}

// A material alone is not.
bool of_a_joint(const ModelWords& words) {
  const modeler::JointChange& change = words.change;
  const bool of_segment = change.segment.size() > change.segment.count("material") || !words.options.empty();
  return words.fixed || words.free || !words.limits.empty() || of_segment || !change.joint.empty() || change.limb ||
         !change.reset.empty();
}

void require_sense_of_options(const ModelWords& words) {
  if (words.fixed && words.free) throw Failure("cannot be both fixed and free", where(words), "leave one of them out");
  if (material_of(words).empty() && !words.material.empty())
    throw Failure("no material is named", where(words), "colours and light are a material's: name it, --material NAME");
}

// Without a joint's name, words are about a material.
void require_sense(const ModelWords& words) {
  require_sense_of_options(words);
  if (words.joint.empty() && material_of(words).empty())
    throw Failure("no joint and no material is named", where(words), "name a joint, or --material NAME");
  if (words.joint.empty() && of_a_joint(words))
    throw Failure("no joint is named", where(words), "name it before its options");
}

bool has_material(const document::Json& model, const std::string& name) {
  return model.contains("materials") && model["materials"].contains(name);
}

document::Json new_model(const ModelWords& words) {
  const bool made_whole = !words.from.empty() || !words.figure.empty();
  if (made_whole && (of_a_joint(words) || !words.joint.empty() || !material_of(words).empty() ||
                     (!words.from.empty() && !words.figure.empty())))
    throw Failure("a model made from another has that one's joints", where(words), "give only --from, or --figure");
  if (!words.from.empty()) return modeler::derived_model(words.from);
  if (!words.figure.empty()) return modeler::library_figure(words.figure, words.height);
  require_sense_of_options(words);
  document::Json model = modeler::empty_model();
  if (!words.material.empty()) modeler::add_material(model, material_of(words), words.material);
  modeler::add_joint(model, words.joint.empty() ? "body" : words.joint, change_of(words));
  return model;
}

void run_new(const ModelWords& words) {
  if (words.replace)
    words.model.change([&](document::Json& model, const modeler::Model&) { model = new_model(words); });
  else
    words.model.create(new_model(words));
}

void run_add(const ModelWords& words) {
  require_sense(words);
  words.model.change([&](document::Json& model, const modeler::Model&) {
    if (words.joint.empty() || !words.material.empty())
      modeler::add_material(model, material_of(words), words.material);
    if (!words.joint.empty()) modeler::add_joint(model, words.joint, change_of(words));
  });
}

void run_set(const ModelWords& words) {
  require_sense(words);
  words.model.change([&](document::Json& model, const modeler::Model&) {
    const std::string material = material_of(words);
    if (words.joint.empty()) return modeler::set_material(model, material, words.material, words.change.name);
    if (!words.material.empty() && !has_material(model, material))
      modeler::add_material(model, material, words.material);
    else if (!words.material.empty())
      modeler::set_material(model, material, words.material, std::nullopt);
    modeler::set_joint(model, words.joint, change_of(words));
  });
}

void run_remove(const ModelWords& words) {
  require_sense(words);
  words.model.change([&](document::Json& model, const modeler::Model&) {
    if (!words.joint.empty()) modeler::remove_joint(model, words.joint, words.branch);
    if (const std::string material = material_of(words); !material.empty()) modeler::remove_material(model, material);
  });
}

void run_scale(const ModelWords& words) {
  modeler::Proportions proportions;
  const bool alike = words.factors.size() == 1;
  const glm::dvec3 factors = words.factors.empty() ? glm::dvec3(1)
                             : alike               ? glm::dvec3(words.factors[0])
                                                   : three_numbers(words.factors);
  for (const std::string& pattern : words.joints) proportions.joints.push_back({pattern, false, factors});
  for (const std::string& pattern : words.branches) proportions.joints.push_back({pattern, true, factors});
  if (proportions.joints.empty()) proportions.scale = factors;
  proportions.height = words.height;
  proportions.ground = !words.no_ground;
  words.model.change(
      [&](document::Json& json, const modeler::Model& model) { modeler::scale_model(json, model, proportions); });
}

void run_mirror(const ModelWords& words) {
  modeler::Mirrored done;
  const modeler::Side from = words.side == "left" ? modeler::Side::left : modeler::Side::right;
  words.model.change([&](document::Json& json, const modeler::Model& model) {
    done = modeler::mirror(json, model, from, words.joint);
  });
  if (!done.changed.empty()) words.model.remark("changed as in a mirror: " + document::joined(done.changed));
  if (!done.added.empty()) words.model.remark("added as in a mirror: " + document::joined(done.added));
}

void run_point(const ModelWords& words) {
  std::string own;
  const modeler::ControlPoint point{words.patch, {words.at[0], words.at[1]}, three_numbers(words.to)};
  words.model.change([&](document::Json& json, const modeler::Model& model) {
    own = modeler::set_point(json, model, words.joint, point);
  });
  if (!own.empty()) words.model.remark("the shape of '" + words.joint + "' is the model's own now: '" + own + "'");
}

void run_show(const ModelWords& words) { words.model.print(modeler::describe_model(words.model.read())); }

void run_check(const ModelWords& words) {
  const modeler::Model model = words.model.read();
  const std::vector<std::string> doubts = modeler::doubts_about(model);
  for (const std::string& doubt : doubts) words.model.print(where(words) + ": " + doubt + "\n");
  words.model.print(where(words) + ": a model of " + document::counted(model.joints.size(), "joint") + ", " +
                    (doubts.empty() ? "no warnings" : document::counted(doubts.size(), "warning")) + "\n");
}

std::string shapes_text() {
  std::string text;
  for (const modeler::LibraryShape& shape : modeler::shape_library()) {
    text += (text.empty() ? "" : ", ") + std::string(shape.name);
    if (shape.option != nullptr) text += " (" + std::string(shape.option->name) + ")";
  }
  return "Shapes of the library, and their options for --with:\n  " + cli::wrapped(text, 2) + "\n";
}

// May be given several times.
template <typename Value>
cli::Option add_several(cli::Command app, const char* name, std::vector<Value>& values, const char* type,
                        const char* help) {
  return app.add(name, values, help).repeated().type(type);
}

void add_limits(cli::Command app, ModelWords& words) {
  add_several(app, "--limits", words.limits, "x|y|z LOWER UPPER",
              "Limits of its angle about one of its axes, in degrees; equal: fixed. Once for each axis. "
              "Example: --limits y -30 60")
      .check([](const std::string& word) {
        const bool number = word.find_first_of("0123456789") != std::string::npos;
        return number || word == "x" || word == "y" || word == "z" ? std::string()
                                                                   : "'" + word + "' is no axis: write x, y or z";
      });
  app.add_flag("--fixed", words.fixed, "Cannot turn, except within --limits. Example: --fixed");
  app.add_flag("--free", words.free, "Turns freely about all axes not given by --limits. Example: --free");
}

void add_options(cli::Command app, ModelWords& words) {
  add_key_options(app, keys::object("joint"), words.change.joint);
  add_limits(app, words);
  add_key_options(app, keys::object("segment"), words.change.segment);
  add_several(app, "--with", words.options, "KEY=NUMBER", "An option of the shape. Example: --with top=0.5");
  app.add("--limb", words.change.limb,
          "The limb of a figure that it is, for walking and other motion: pelvis, head, left.knee ... Example: "
          "--limb left.hip")
      .type("LIMB");
  add_key_options(app, keys::object("material"), words.material);
  app.footer(shapes_text());
}

void add_height(cli::Command app, ModelWords& words, const char* help) {
  limit(app.add("--height", words.height, help).type("LENGTH"), keys::object("proportions").key("height"));
}

struct Verb {
  const char* name;
  const char* purpose;
  void (*run)(const ModelWords& words);
  void (*add)(cli::Command app, ModelWords& words);
};

constexpr Verb kVerbs[] = {
    {"new", "Make a model of one joint, or one that differs from another by proportions", run_new,
     [](cli::Command app, ModelWords& words) {
       app.add("JOINT", words.joint, "The joint's name; default: body. Example: body");
       app.add("--from", words.from, "Another model file, relative to the new one. Example: --from human.json")
           .type("MODEL");
       app.add("--figure", words.figure,
               "A figure or object of the library, with joints of its own. Example: --figure man")
           .type("FIGURE");
       add_height(app, words, "How high that is at rest. Example: --height 4.6");
       app.add_flag("--replace", words.replace,
                    "Replace the model that the file holds, with all its joints. Example: --replace");
       add_options(app, words);
     }},
    {"show", "Show a model's joints, how they turn, and their segments", run_show, [](cli::Command, ModelWords&) {}},
    {"add", "Add a joint, or a material, or both", run_add,
     [](cli::Command app, ModelWords& words) {
       app.add("JOINT", words.joint, "The new joint; none: only a material. Example: leg");
       add_options(app, words);
     }},
    {"set", "Change a joint, or a material, or both", run_set,
     [](cli::Command app, ModelWords& words) {
       app.add("JOINT", words.joint, "The joint; none: only a material. Example: leg");
       app.add("--name", words.change.name, "Another name for the joint, else for the material. Example: --name paw")
           .type("NAME");
       add_options(app, words);
       add_several(app, "--reset", words.change.reset, "WHAT",
                   "Back to its default: parent, place, axes, limits, segment, sbb, material or limb. "
                   "Example: --reset axes")
           .one_of({std::begin(modeler::kResets), std::end(modeler::kResets)});
     }},
    {"scale", "Make all, or some joints, larger or smaller along their own axes", run_scale,
     [](cli::Command app, ModelWords& words) {
       limit(app.add("FACTOR", words.factors, "One for all axes, or three for x, y and z. Example: 1.2").words(0, 3),
             keys::object("proportions").key("scale"));
       add_several(app, "--joint", words.joints, "PATTERN",
                   "Only these joints; * stands for any text. Example: --joint '*-thigh'");
       add_several(app, "--branch", words.branches, "PATTERN",
                   "Only these joints and all below them. Example: --branch head");
       add_height(app, words, "Then scale all joints alike to this height at rest. Example: --height 1.2");
       app.add_flag("--no-ground", words.no_ground,
                    "Do not keep the lowest point at rest at its height. Example: --no-ground");
       app.checks([&words] {
         if (words.factors.size() == 2) throw cli::UsageError("FACTOR", "give one for all axes, or three");
         if (words.factors.empty() && !words.height) throw cli::UsageError("FACTOR", "give it, or --height");
       });
     }},
    {"remove", "Remove a joint, or a material", run_remove,
     [](cli::Command app, ModelWords& words) {
       app.add("JOINT", words.joint, "The joint. Example: leg");
       app.add_flag("--branch", words.branch, "With all joints below it. Example: --branch");
       const auto read = [&words](const std::string& name) { words.change.segment["material"] = name; };
       app.add_read("--material", read, "The material to remove. Example: --material fur").type("NAME");
     }},
    {"mirror", "Put the limbs of one side on the other", run_mirror,
     [](cli::Command app, ModelWords& words) {
       app.add("SIDE", words.side, "The side that is as it should be: left or right. Example: left")
           .required()
           .one_of({"left", "right"});
       app.add("JOINT", words.joint, "Only this joint and all below it. Example: left-shoulder");
     }},
    {"point", "Move a control point of a joint's shape, which then becomes the model's own", run_point,
     [](cli::Command app, ModelWords& words) {
       app.add("JOINT", words.joint, "The joint. Example: leg").required();
       app.add("--patch", words.patch, "Which of its patches, from 0; default: 0. Example: --patch 2").type("N");
       app.add("--at", words.at, "The point's column and row in the patch, from 0. Example: --at 1 2")
           .words(2)
           .type("I J")
           .required();
       app.add("--to", words.to, "Its place in the unit cube of the shape. Example: --to 0.5 0.2 1")
           .words(3)
           .type("X Y Z")
           .required();
     }},
    {"check", "Check a model, and report what is probably a mistake", run_check, [](cli::Command, ModelWords&) {}},
};

}  // namespace

cli::Command add_model(cli::Command mars, EditedModel& model) {
  const cli::Command app = mars.add_command("model", "Make a model, or change it step by step");
  for (const Verb& verb : kVerbs) {
    const auto words = std::make_shared<ModelWords>(model);
    const cli::Command command = app.add_command(verb.name, verb.purpose);
    verb.add(command, *words);
    command.runs([words, run = verb.run] { run(*words); });
  }
  app.footer(kNewFigureExample);  // last, or each of its commands would have it
  return app;
}

std::vector<std::string_view> model_verbs() {
  std::vector<std::string_view> names;
  for (const Verb& verb : kVerbs) names.push_back(verb.name);
  return names;
}

}  // namespace mars::editing
