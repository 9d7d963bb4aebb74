// The materials of a film's segments: each is stored once, whoever it belongs to.
#pragma once

#include <string>
#include <unordered_map>

#include "host/content/animator/pose/worn_materials.h"
#include "host/content/film/track_writer.h"
#include "node/wire/film.h"

namespace mars::film {

class MaterialWriter {
 public:
  MaterialWriter(const animator::Film& film, WrittenFrames frames, wire::FilmData& data);
  MaterialWriter(const animator::Film&&, auto&&...) = delete;

  // The track of what a segment of the actor is made of, `name` being its own material ("": none). Throws if there is
  // no such material.
  wire::Track track_of(const animator::Actor& actor, const std::string& name);

  // And that material's name.
  std::string name_of(const animator::Actor& actor, const std::string& name) const;
  // Whether a segment is made of the film's material.
  bool uses(const animator::MaterialMotion& material) const { return tracks_.contains(&material); }

 private:
  wire::Track write(const animator::MaterialMotion& motion);
  wire::Track write(const wire::Material& material);
  wire::Material material_at(const animator::MaterialMotion& motion, std::uint32_t frame) const;
  template <typename Material>
  wire::Track shared(const Material& material);

  const animator::Film& film_;
  const WrittenFrames frames_;
  wire::FilmData& data_;
  animator::WornMaterials worn_;
  std::unordered_map<const void*, wire::Track> tracks_;  // of materials of the film and its models
};

}  // namespace mars::film
