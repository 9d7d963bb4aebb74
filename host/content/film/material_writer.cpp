#include "host/content/film/material_writer.h"

#include <algorithm>

#include "hal/failure/failure.h"
#include "host/content/film/light_writer.h"

namespace mars::film {

using modeler::kMaterialNumbers;

MaterialWriter::MaterialWriter(const animator::Film& film, WrittenFrames frames, wire::FilmData& data)
    : film_(film), frames_(frames), data_(data), worn_(film) {}

wire::Track MaterialWriter::track_of(const animator::Actor& actor, const std::string& name) {
  const auto worn = worn_.of(actor, name);
  if (!worn) {
    const std::string element = "actor '" + actor.name + "'";
    throw Failure("uses the material '" + animator::WornMaterials::name_of(actor, name) + "', which there is not",
                  film_.source.empty() ? element : film_.source + ": " + element, "add it to the film's materials");
  }
  if (worn->of_film) return shared(*worn->of_film);
  return shared(worn->of_model ? worn->of_model->material : modeler::default_material());
}

std::string MaterialWriter::name_of(const animator::Actor& actor, const std::string& name) const {
  const auto worn = worn_.of(actor, name);
  if (worn && worn->of_film) return worn->of_film->name;
  return worn && worn->of_model ? worn->of_model->name : "default";
}

// Segments of one material share a track.
template <typename Material>
wire::Track MaterialWriter::shared(const Material& material) {
  const auto known = tracks_.find(&material);
  return known != tracks_.end() ? known->second : tracks_.emplace(&material, write(material)).first->second;
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
