// Strips as nodes send them, for tests.
#pragma once

#include <cstring>
#include <vector>

#include "host/render/farm/strip_message.h"

namespace mars::farm {

struct Runs {
  std::vector<wire::Run> runs;
  std::vector<std::uint32_t> pixels;  // their words
};

// A whole strip with `header`'s names and these contents, as it lies in a slot or travels, in memory of `store`.
inline StripBytes strip_bytes(wire::Strip header, const Runs& constant, const Runs& moving, StripStore& store,
                              wire::PixelFormat format = wire::PixelFormat::rgb8) {
  header.constant_runs = static_cast<std::uint32_t>(constant.runs.size());
  header.moving_runs = static_cast<std::uint32_t>(moving.runs.size());
  const std::size_t words = constant.pixels.size() + moving.pixels.size();
  header.pixels = words / wire::pixel_words(format);
  const std::size_t runs = (constant.runs.size() + moving.runs.size()) * sizeof(wire::Run);
  StripBytes bytes = store.take(sizeof header + words * sizeof(std::uint32_t) + runs);
  std::byte* to = bytes.data.get();
  const auto append = [&](const void* from, std::size_t size) {
    if (size > 0) std::memcpy(to, from, size);
    to += size;
  };
  append(&header, sizeof header);
  for (const Runs* part : {&constant, &moving})
    append(part->pixels.data(), part->pixels.size() * sizeof(std::uint32_t));
  for (const Runs* part : {&constant, &moving}) append(part->runs.data(), part->runs.size() * sizeof(wire::Run));
  return bytes;
}

}  // namespace mars::farm
