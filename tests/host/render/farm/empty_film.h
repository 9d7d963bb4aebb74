// A compiled film with nothing to see, for tests of what the host does with one.
#pragma once

#include <cstring>
#include <span>
#include <vector>

#include "node/wire/film.h"

namespace mars::farm {

class EmptyFilm {
 public:
  // `intervals`: the frames of each interval. The block has more than `bytes`.
  explicit EmptyFilm(const std::vector<std::uint32_t>& intervals, std::uint32_t width = 16, std::uint32_t height = 8,
                     std::size_t bytes = 0) {
    pack(data(intervals, width, height, bytes));
  }
  static EmptyFilm of(const wire::FilmData& data) {
    EmptyFilm film({1});
    film.pack(data);
    return film;
  }

  static wire::FilmData data(const std::vector<std::uint32_t>& intervals, std::uint32_t width = 16,
                             std::uint32_t height = 8, std::size_t bytes = 0) {
    wire::FilmData film;
    for (const std::uint32_t frames : intervals) {
      film.intervals.push_back({film.settings.frames, frames, 0, 0});
      film.settings.frames += frames;
    }
    film.settings.width = width;
    film.settings.height = height;
    film.settings.rate = 24;
    film.settings.camera = {0, 1};
    film.cameras = {{{{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}}}, 2, 0.1, 100}};
    film.changes = {{0, 0}};
    film.names.resize(bytes);
    return film;
  }

  std::span<const std::byte> block() const { return {reinterpret_cast<const std::byte*>(words_.data()), size_}; }
  wire::PackedFilm view() const { return {block(), "empty film"}; }

 private:
  void pack(const wire::FilmData& data) {
    const std::vector<std::byte> block = wire::pack(data);
    words_.resize((block.size() + 7) / 8);
    size_ = block.size();
    std::memcpy(words_.data(), block.data(), size_);
  }

  std::vector<std::uint64_t> words_;  // aligned as PackedFilm wants it
  std::size_t size_;
};

}  // namespace mars::farm
