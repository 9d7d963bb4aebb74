#include "host/images/surface_names.h"

#include <bit>
#include <cstring>
#include <nlohmann/json.hpp>

#include "hal/failure/failure.h"
#include "host/content/document/text.h"
#include "node/wire/pixel_format.h"

namespace mars::images {
namespace {

constexpr std::array<std::string_view, kMattes.size()> kNames{"CryptoActor", "CryptoJoint", "CryptoMaterial"};

std::uint32_t scrambled(std::uint32_t block) { return std::rotl(block * 0xcc9e2d51u, 15) * 0x1b873593u; }

// Of "actor/joint".
std::string_view actor_of(std::string_view segment) { return segment.substr(0, segment.find('/')); }

}  // namespace

std::string_view name_of(Matte matte) { return kNames.at(static_cast<std::size_t>(matte)); }

// Austin Appleby's MurmurHash3_x86_32 with seed 0 (github.com/aappleby/smhasher, in the public domain).
std::uint32_t murmur_hash3(std::string_view text) {
  constexpr std::size_t kBlock = sizeof(std::uint32_t);
  std::uint32_t hash = 0;
  const auto length = static_cast<std::uint32_t>(text.size());
  while (!text.empty()) {
    std::uint32_t block = 0;
    const std::size_t bytes = std::min(kBlock, text.size());
    std::memcpy(&block, text.data(), bytes);
    text.remove_prefix(bytes);
    hash ^= scrambled(block);
    if (bytes == kBlock) hash = std::rotl(hash, 13) * 5 + 0xe6546b64u;
  }
  hash ^= length;
  hash = (hash ^ hash >> 16) * 0x85ebca6bu;
  hash = (hash ^ hash >> 13) * 0xc2b2ae35u;
  return hash ^ hash >> 16;
}

std::uint32_t matte_id(std::string_view name) {
  const std::uint32_t hash = murmur_hash3(name), exponent = hash >> 23 & 0xff;
  return exponent == 0 || exponent == 0xff ? hash ^ 1u << 23 : hash;
}

SurfaceNames::SurfaceNames(const wire::PackedFilm& film) {
  if (film.segments().size() > wire::kMostSurfaceSegments)
    throw Failure("has more segments than the layer ids can tell apart", "", "name other layers");
  for (const wire::Segment& segment : film.segments()) {
    const std::string_view joint = film.name(segment);
    const std::array<std::string_view, kMattes.size()> names{actor_of(joint), joint, film.material_name(segment)};
    auto& ids = ids_.emplace_back();
    for (std::size_t matte = 0; matte < names.size(); ++matte)
      names_[matte][std::string(names[matte])] = ids[matte] = matte_id(names[matte]);
  }
}

std::string SurfaceNames::manifest(Matte matte) const {
  nlohmann::json manifest = nlohmann::json::object();
  for (const auto& [name, id] : names_[static_cast<std::size_t>(matte)])
    manifest[name] = document::formatted("%08x", id);
  return manifest.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
}

}  // namespace mars::images
