#include "host/render/sinks/pixel_hash.h"

#include <nlohmann/json.hpp>
#include <vector>

#include "host/content/document/checksum.h"
#include "host/render/sinks/record.h"

namespace mars::sinks {
namespace {

constexpr char kOfBands = 'b';

bool is_of_bands(const std::string& hash) { return hash.starts_with(kOfBands) && is_checksum(hash.substr(1)); }

}  // namespace

std::string hash_of_band(std::span<const std::uint32_t> pixels) { return document::checksum_of(std::as_bytes(pixels)); }

std::string hash_of_bands(std::span<const std::string> bands) {
  document::Checksum all;
  for (const std::string& band : bands) all.add(std::as_bytes(std::span(band)));
  return kOfBands + all.digits();
}

std::string pixel_hash_like(const std::string& like, const images::PictureBands& bands,
                            std::span<const std::uint32_t> pixels) {
  if (!is_of_bands(like)) return document::checksum_of(std::as_bytes(pixels));
  std::vector<std::string> hashes;
  for (std::size_t band = 0; band < bands.count(); ++band) hashes.push_back(hash_of_band(bands.part_of(pixels, band)));
  return hash_of_bands(hashes);
}

bool is_pixel_hash(const nlohmann::json& value) {
  return is_checksum(value) || (value.is_string() && is_of_bands(value.get_ref<const std::string&>()));
}

}  // namespace mars::sinks
