#include "host/content/film/material_writer.h"

#include <algorithm>

#include "hal/failure/failure.h"
#include "host/content/film/light_writer.h"

namespace mars::film {

using modeler::kMaterialNumbers;

MaterialWriter::MaterialWriter(const animator::Film& film, WrittenFrames frames, wire::FilmData& data)
    : film_(film), frames_(frames), data_(data) {
  for (const animator::MaterialMotion& motion : film.materials) of_film_.emplace(motion.name, &motion);
}

wire::Track MaterialWriter::track_of(const animator::Actor& actor, std::string name) {
  bool of_film = !actor.material.empty();
  if (of_film) name = actor.material;
  const auto instead = std::find_if(actor.materials.begin(), actor.materials.end(),
                                    [&](const auto& change) { return change.first == name; });
  if (!of_film && instead != actor.materials.end()) {
    name = instead->second;
    of_film = true;
  }
  if (name.empty()) return shared("", modeler::default_material());
  if (!of_film)
    for (const modeler::NamedMaterial& own : film_.models[actor.model].materials)
      if (own.name == name) return shared(std::to_string(actor.model) + "/" + name, own.material);
  if (const auto found = of_film_.find(name); found != of_film_.end()) return shared("/" + name, *found->second);
  const std::string element = "actor '" + actor.name + "'";
  throw Failure("uses the material '" + name + "', which there is not",
                film_.source.empty() ? element : film_.source + ": " + element, "add it to the film's materials");
}

// Segments of one material share a track. `key` names the material among all of the film's and its models'.
template <typename Material>
wire::Track MaterialWriter::shared(const std::string& key, const Material& material) {
  const auto known = tracks_.find(key);
  return known != tracks_.end() ? known->second : tracks_.emplace(key, write(material)).first->second;
}

wire::Material MaterialWriter::material_at(const animator::MaterialMotion& motion, std::uint32_t frame) const {
  wire::Material material = motion.shading;
  material.color = light_of(animator::value_at(motion.color, frame), film_.color);
  for (std::size_t i = 0; i < kMaterialNumbers.size(); ++i) {
    const modeler::MaterialNumber& number = kMaterialNumbers[i];
    material.*number.member = static_cast<float>(
        std::clamp(animator::value_at(motion.numbers[i], frame), number.key.range.lowest, number.key.range.highest));
  }
  return material;
}

wire::Track MaterialWriter::write(const animator::MaterialMotion& motion) {
  TrackWriter<wire::Material> track(data_.materials);
  std::uint32_t frames = frames_to_see(frames_.count, motion.color);
  for (const auto& channel : motion.numbers) frames = std::max(frames, frames_to_see(frames_.count, channel));
  for (std::uint32_t frame = 0; frame < frames; ++frame) track.add(frame, material_at(motion, frames_.first + frame));
  return track.write(data_.changes);
}

wire::Track MaterialWriter::write(const wire::Material& material) {
  TrackWriter<wire::Material> track(data_.materials);
  wire::Material lit = material;
  lit.color = light_of({material.color[0], material.color[1], material.color[2]}, film_.color);
  track.add(0, lit);
  return track.write(data_.changes);
}

}  // namespace mars::film
