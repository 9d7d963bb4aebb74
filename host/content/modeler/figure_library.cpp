#include "host/content/modeler/figure_library.h"

#include <vector>

#include "hal/failure/failure.h"
#include "host/content/modeler/figure_texts.h"
#include "host/content/modeler/model_file.h"
#include "host/content/modeler/scale_model.h"

namespace mars::modeler {
namespace {

constexpr LibraryFigure kFigures[] = {{"man", "5.1 units tall, 2.9 to a metre", kHumanText, ""},
                                      {"child", "a smaller body of the man's segments", kHumanText, kChildText},
                                      {"tall", "a tall body of the man's segments", kHumanText, kTallText},
                                      {"stout", "a stout body of the man's segments", kHumanText, kStoutText},
                                      {"dog", "a shoulder height of 1.6 units, 2.9 to a metre", kDogText, ""},
                                      {"horse", "5.8 units tall, 2.9 to a metre", kHorseText, ""}};

constexpr LibraryFigure kObjects[] = {{"ball", "0.55 wide, 19 cm; its place is its middle", kBallText, "", true},
                                      {"box", "1.3 high, 45 cm: a seat, too", kBoxText, ""},
                                      {"chair", "its seat 1.3 high, it faces x", kChairText, ""},
                                      {"table", "2.12 high, 73 cm", kTableText, ""},
                                      {"floor", "58 by 58 units, 20 by 20 m, its top at height 0", kFloorText, ""}};

Model meaning_of(const document::Json& json) {
  const document::Document document(json.dump(), "figure");
  return read_own_model(document.root());
}

void give_proportions(document::Json& json, std::string_view text) {
  const document::Document derived(text, "proportions");
  scale_model(json, meaning_of(json), read_proportions(*derived.root().find("proportions")));
  const document::Json others = document::Json::parse(text);
  if (others.contains("materials"))
    for (const auto& [name, material] : others["materials"].items()) json["materials"][name] = material;
}

}  // namespace

std::span<const LibraryFigure> figure_library() { return kFigures; }

std::span<const LibraryFigure> object_library() { return kObjects; }

const LibraryFigure* find_in_library(std::string_view name) {
  for (const std::span<const LibraryFigure> library : {figure_library(), object_library()})
    for (const LibraryFigure& each : library)
      if (each.name == name) return &each;
  return nullptr;
}

document::Json library_figure(const std::string& name, const std::optional<double>& height) {
  const LibraryFigure* figure = find_in_library(name);
  if (figure == nullptr) {
    std::vector<std::string_view> names;
    for (const auto library : {figure_library(), object_library()})
      for (const LibraryFigure& each : library) names.push_back(each.name);
    throw Failure("is no figure or object of the library", "'" + name + "'",
                  document::did_you_mean(name, names, "choose " + document::joined(names)));
  }
  document::Json json = document::Json::parse(figure->model);
  if (!figure->proportions.empty()) give_proportions(json, figure->proportions);
  if (!height) return json;
  Proportions proportions;
  proportions.height = height;
  proportions.ground = !figure->centred;
  scale_model(json, meaning_of(json), proportions);
  return json;
}

}  // namespace mars::modeler
