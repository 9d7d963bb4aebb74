// Which frames of a film a person wants, as written on a command line: "0-9,24,30-" is frames 0 to 9, frame
// 24 and frame 30 up to the film's last; "0-99x5" is every fifth of frames 0 to 99.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace mars::film {

class FrameSet {
 public:
  struct Stretch {
    std::uint32_t first;
    std::optional<std::uint32_t> last;  // none: to the film's end
    std::uint32_t step = 1;             // from frame to frame, at least 1

    bool operator==(const Stretch&) const = default;
  };

  // Every frame.
  FrameSet() : stretches_{{0, std::nullopt}} {}
  // Throws Failure saying which part of `text` is wrong.
  explicit FrameSet(const std::string& text);
  // These frames, which ascend.
  explicit FrameSet(std::span<const std::uint32_t> frames);

  // As it may be written on a command line; "" for no frame.
  std::string text() const;
  const std::vector<Stretch>& stretches() const { return stretches_; }
  // Of each stretch the first and every `step`th after it.
  FrameSet every(std::uint32_t step) const;
  // The frames of a film of `film_frames`, ascending, each once. Throws Failure where the film is too short.
  std::vector<std::uint32_t> of_film(std::uint32_t film_frames) const;

  // Whether it is a quarter of such a film's frames at most; throws as of_film() does.
  bool is_small_part(std::uint32_t film_frames) const;

  // The first `count` of its frames, ascending; all, where it has fewer.
  std::vector<std::uint32_t> first_frames(std::uint32_t count) const;

  bool operator==(const FrameSet&) const = default;

 private:
  std::vector<Stretch> stretches_;  // as written
};

// For people: "frame 7", "frames 3,5-9". The frames ascend.
std::string frames_text(std::span<const std::uint32_t> frames);

}  // namespace mars::film
