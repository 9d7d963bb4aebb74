// Which frames a film of a glTF file has, and where the file's nodes are at them.
#pragma once

#include <cstddef>
#include <filesystem>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <optional>
#include <vector>

#include "host/content/importer/gltf/gltf_scene.h"

namespace mars::importer {

struct FilmClock {
  double rate = 24;
  std::size_t frames = 1;  // of which the first is at time 0, the last not after the animation's end

  double time(std::size_t frame) const { return double(frame) / rate; }
};

// At `rate` frames a second; none: of 24, 25, 30, 48, 50, 60, 100 and 120 the first at whose frames all values of the
// animation are given, made a film's by kind_rate(), else 24. Refuses more than a million frames.
FilmClock film_clock(const std::filesystem::path& path, const GltfScene& scene, const std::optional<double>& rate);

// How each node stands in the one above it while a film's model rests: as the file says, but with places and scales
// that the animation gives and never changes.
std::vector<glm::dmat4> rest_of_nodes(const GltfScene& scene, const FilmClock& clock);

// From each node's axes to the film's, in the film's units: `upright` turns the file's axes into these.
class NodesInFilm {
 public:
  NodesInFilm(const GltfScene& scene, const FilmClock& clock, const glm::dmat3& upright, double factor);
  NodesInFilm(const GltfScene&&, auto&&...) = delete;

  std::size_t frames() const { return clock_.frames; }
  std::vector<glm::dmat4> at(std::size_t frame) const;
  // Where `rest` is how each node stands in the one above it.
  std::vector<glm::dmat4> at_rest(const std::vector<glm::dmat4>& rest) const;

 private:
  std::vector<glm::dmat4> in_film(std::vector<glm::dmat4> matrices) const;

  const GltfScene& scene_;
  FilmClock clock_;
  glm::dmat4 to_film_;
};

}  // namespace mars::importer
