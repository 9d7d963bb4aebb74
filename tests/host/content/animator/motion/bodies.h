// Figures of several builds in a film, and how a test has them act.
#pragma once

#include <algorithm>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "host/content/animator/motion/script/action.h"
#include "host/content/animator/reading/read_film.h"

namespace mars::motion {

struct Build {
  std::string name;
  document::Json model;
  double leg;  // length, in the model's unit
};

// A model of examples/models, which is read once.
inline document::Json example(const std::string& name) {
  static std::map<std::string, document::Json> known;
  document::Json& model = known[name];
  if (model.is_null())
    model = document::read_json(std::filesystem::path(MARS_SOURCE_DIR) / "examples/models" / (name + ".json"));
  return model;
}

inline document::Json human() { return example("human"); }

// Another body of the man's parts: everything times `size`, with longer or shorter legs, and wider.
inline document::Json built(double size, double legs, double width) {
  document::Json model = human();
  const auto shape = [&](document::Json& point, double height) {
    for (int axis = 0; axis < 3; ++axis)
      point[axis] = point[axis].get<double>() * size * (axis == 1 ? width : axis == 2 ? height : 1);
  };
  for (document::Json& joint : model["joints"]) {
    const auto name = joint["name"].get<std::string>();
    const bool below_bone = name.ends_with("shin") || name.ends_with("-foot") || name == "pelvis";
    const bool bone = name.ends_with("thigh") || name.ends_with("shin");
    if (joint.contains("place")) shape(joint["place"], below_bone ? legs : 1);
    if (joint.contains("segment"))
      for (document::Json& corner : joint["segment"]["sbb"]) shape(corner, bone ? legs : 1);
  }
  return model;
}

inline document::Json jointed(const std::string& name, const std::string& parent, const document::Json& place,
                              const document::Json& limits, const document::Json& sbb, const char* shape = "box") {
  document::Json joint{{"name", name}, {"place", place}, {"segment", {{"shape", shape}, {"sbb", sbb}}}};
  if (!parent.empty()) joint["parent"] = parent;
  if (!limits.is_null()) joint["limits"] = limits;
  return joint;
}

// Of boxes, every joint a hinge: it can neither sway nor turn.
inline document::Json robot() {
  document::Json joints = document::Json::array(
      {jointed("hull", "", {0, 0, 95}, document::Json::object(), {{-15, -25, -5}, {15, 25, 60}})});
  document::Json limbs{{"pelvis", "hull"}};
  for (const std::string side : {"left", "right"}) {
    const double y = side == "left" ? 18 : -18;
    joints.push_back(jointed(side + " thigh", "hull", {0, y, 0}, {{"y", {-100, 60}}}, {{-6, -6, -45}, {6, 6, 5}}));
    joints.push_back(
        jointed(side + " shin", side + " thigh", {0, 0, -45}, {{"y", {0, 120}}}, {{-5, -5, -42}, {5, 5, 5}}));
    joints.push_back(
        jointed(side + " foot", side + " shin", {0, 0, -42}, {{"y", {-60, 60}}}, {{-10, -8, -8}, {20, 8, 2}}));
    joints.push_back(jointed(side + " arm", "hull", {0, 1.7 * y, 55}, {{"y", {-170, 90}}}, {{-4, -4, -30}, {4, 4, 4}}));
    limbs[side] = {
        {"hip", side + " thigh"}, {"knee", side + " shin"}, {"ankle", side + " foot"}, {"shoulder", side + " arm"}};
  }
  return {{"limbs", limbs}, {"joints", joints}};
}

// It is drawn looking along -y, and its legs are of one piece.
inline document::Json bird() {
  document::Json joints = document::Json::array(
      {jointed("body", "", {0, 0, 1.04}, {}, {{-0.5, -0.7, -0.3}, {0.5, 0.6, 0.6}}, "sphere"),
       jointed("head", "body", {0, -0.6, 0.6}, {{"x", {-40, 40}}}, {{-0.2, -0.3, -0.1}, {0.2, 0.2, 0.3}})});
  document::Json limbs{{"pelvis", "body"}, {"head", "head"}};
  for (const std::string side : {"left", "right"}) {
    const double x = side == "left" ? 0.25 : -0.25;
    joints.push_back(jointed(side + " leg", "body", {x, 0, 0}, {}, {{-0.05, -0.05, -1}, {0.05, 0.05, 0}}));
    joints.push_back(jointed(side + " foot", side + " leg", {0, 0, -1}, {}, {{-0.1, -0.3, -0.04}, {0.1, 0.1, 0.02}}));
    limbs[side] = {{"hip", side + " leg"}, {"ankle", side + " foot"}};
  }
  return {{"limbs", limbs}, {"joints", joints}};
}

// Legs of one piece in a box, with hips so far aside, that turn freely or about one axis.
inline document::Json stilts(double leg, double aside, const document::Json& limits) {
  const double wide = 0.9 * std::min(aside, 0.1 * leg);
  document::Json joints =
      document::Json::array({jointed("hull", "", {0, 0, 1.1 * leg}, {}, {{-0.1, -aside, 0}, {0.1, aside, leg / 2}})});
  document::Json limbs{{"pelvis", "hull"}};
  for (const std::string side : {"left", "right"}) {
    const double y = side == "left" ? aside : -aside;
    joints.push_back(jointed(side + " leg", "hull", {0, y, 0}, limits, {{-0.02, -wide, -leg}, {0.02, wide, 0}}));
    joints.push_back(jointed(side + " foot", side + " leg", {0, 0, -leg}, limits,
                             {{-0.1 * leg, -wide, -0.1 * leg}, {0.2 * leg, wide, 0.02}}));
    limbs[side] = {{"hip", side + " leg"}, {"ankle", side + " foot"}};
  }
  return {{"limbs", limbs}, {"joints", joints}};
}

// The man, changed: limits of all joints whose names end so.
inline document::Json limited(document::Json model, const std::string& end, const char* axis,
                              const document::Json& limits) {
  for (document::Json& joint : model["joints"])
    if (joint["name"].get<std::string>().ends_with(end)) joint["limits"][axis] = limits;
  return model;
}

inline document::Json film_with(const document::Json& model) {
  return {{"frames", 1000},
          {"camera", {{"eye", {0, -9, 2}}}},
          {"models", {{"figure", model}}},
          {"actors", document::Json::array(
                         {{{"name", "anna"}, {"model", "figure"}, {"place", {1, 2, 0}}, {"turn", {0, 0, 30}}}})}};
}

// Reading models takes longest: films that have the same models share them.
inline animator::Film read(const document::Json& json) {
  static std::vector<std::pair<document::Json, std::vector<modeler::Model>>> known;
  const document::Document document(document::laid_out(json), "film.json");
  const auto found =
      std::ranges::find_if(known, [&](const auto& film) { return animator::same_models(film.first, json); });
  if (found != known.end()) {
    std::vector<modeler::Model> models = found->second;
    return animator::read_film(document.root(), models);
  }
  animator::Film film = animator::read_film(document.root(), ".");
  known.insert(known.begin(), {json, film.models});
  return film;
}

// "walk steps 4 lean 5", from a frame on, or else from the last key.
inline Performed act(document::Json& film, const std::string& text, std::optional<std::uint32_t> at = {}) {
  std::vector<std::string> words;
  for (std::size_t from = 0; from < text.size();) {
    const std::size_t to = std::min(text.find(' ', from), text.size());
    words.push_back(text.substr(from, to - from));
    from = to + 1;
  }
  const Action& action = *find_action(words[0]);
  Arguments::Values values;
  for (std::size_t i = 1; i < words.size();) {
    const std::string name = words[i++];
    for (const Parameter& parameter : action.parameters)
      if (parameter.name == name)
        for (std::size_t k = 0; k < parameter.count(); ++k) values[name].push_back(words.at(i++));
  }
  return perform(film, read(film), "anna", action, at, Arguments(values, std::string(action.name)));
}

}  // namespace mars::motion
