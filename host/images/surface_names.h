// The names of what a film shows, as Cryptomatte files have them: of each segment its actor, its joint ("actor/joint")
// and its material, as 32 bits that a float carries.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "node/wire/film.h"

namespace mars::images {

enum class Matte : std::size_t { actor, joint, material };
inline constexpr std::array kMattes{Matte::actor, Matte::joint, Matte::material};
// The layer's name in files: "CryptoActor".
std::string_view name_of(Matte matte);

// A name's 32 bits: MurmurHash3_x86_32 of its UTF-8 text, changed where the float would be no number or have few
// digits, as Cryptomatte's uint32_to_float32 says.
std::uint32_t matte_id(std::string_view name);
// The hash alone.
std::uint32_t murmur_hash3(std::string_view text);

class SurfaceNames {
 public:
  // Throws Failure where the film has more than wire::kMostSurfaceSegments.
  explicit SurfaceNames(const wire::PackedFilm& film);

  std::size_t segments() const { return ids_.size(); }
  std::uint32_t id(Matte matte, std::uint32_t segment) const { return ids_[segment][static_cast<std::size_t>(matte)]; }
  // The names of a matte as a Cryptomatte manifest, JSON: from each name to its 8 hexadecimal digits.
  std::string manifest(Matte matte) const;

 private:
  std::vector<std::array<std::uint32_t, kMattes.size()>> ids_;
  std::array<std::map<std::string, std::uint32_t>, kMattes.size()> names_;
};

}  // namespace mars::images
