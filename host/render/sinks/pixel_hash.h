// The hash of a frame's pixels: the hash of its bands' hashes (host/images/picture_bands.h), so that of bands that have
// not changed no pixel is read again. As text "b" and 32 hexadecimal digits; frames of manifests up to version 2 have
// a hash over all pixels at once, 32 digits.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>

#include "host/images/picture_bands.h"

namespace mars::sinks {

// Of the pixels of one band, as words: 32 digits.
std::string hash_of_band(std::span<const std::uint32_t> pixels);
// Of a frame whose bands have these hashes.
std::string hash_of_bands(std::span<const std::string> bands);

// Of a picture's pixels, in the form that `like` has.
std::string pixel_hash_like(const std::string& like, const images::PictureBands& bands,
                            std::span<const std::uint32_t> pixels);

// Whether it is the text of one, of either form.
bool is_pixel_hash(const nlohmann::json& value);

}  // namespace mars::sinks
