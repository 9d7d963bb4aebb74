// The materials of a film's segments: each is stored once, whoever it belongs to.
#pragma once

#include <string>
#include <string_view>
#include <unordered_map>

#include "host/content/animator/pose/film.h"
#include "host/content/film/track_writer.h"
#include "node/wire/film.h"

namespace mars::film {

class MaterialWriter {
 public:
  MaterialWriter(const animator::Film& film, WrittenFrames frames, wire::FilmData& data);

  // The track of what a segment of the actor is made of, `name` being its own material ("": none). Throws if there is
  // no such material.
  wire::Track track_of(const animator::Actor& actor, std::string name);

  // Whether a segment is made of the film's material.
  bool uses(const std::string& name) const { return tracks_.contains("/" + name); }

 private:
  wire::Track write(const animator::MaterialMotion& motion);
  wire::Track write(const wire::Material& material);
  wire::Material material_at(const animator::MaterialMotion& motion, std::uint32_t frame) const;
  template <typename Material>
  wire::Track shared(const std::string& key, const Material& material);

  const animator::Film& film_;
  const WrittenFrames frames_;
  wire::FilmData& data_;
  std::unordered_map<std::string_view, const animator::MaterialMotion*> of_film_;
  std::unordered_map<std::string, wire::Track> tracks_;
};

}  // namespace mars::film
