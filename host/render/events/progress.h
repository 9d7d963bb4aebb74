// How far a rendering is. Keyframes and inbetweens are kept apart, for a keyframe may cost a hundred times an
// inbetween: the time until a frame came is counted to its kind, so that all seconds are counted once.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "node/wire/protocol.h"

namespace mars::events {

using wire::FrameKind;

struct Progress {
  struct Kind {
    std::uint32_t done = 0;
    std::uint32_t of = 0;
    double seconds = 0;  // spent until those done were there

    bool operator==(const Kind&) const = default;
  };

  std::uint32_t interval = 0;   // of the frame that came last
  std::uint32_t intervals = 0;  // of the film
  Kind keyframes;
  Kind inbetweens;

  std::uint32_t done() const { return keyframes.done + inbetweens.done; }
  std::uint32_t of() const { return keyframes.of + inbetweens.of; }
  double seconds() const { return keyframes.seconds + inbetweens.seconds; }

  // A frame of `kind` came, `at_seconds` after the start; where frames that came later were counted before, it took
  // no time.
  void count(FrameKind kind, std::uint32_t of_interval, double at_seconds);

  // Seconds that the rest of each kind will take: as forecast, else as long as those that came; none before anything
  // is known.
  struct Left {
    double keyframes = 0;
    double inbetweens = 0;
    std::optional<std::array<double, 2>> between{};  // in which all seconds lie, nine times of ten

    double seconds() const { return keyframes + inbetweens; }
    bool operator==(const Left&) const = default;
  };
  std::optional<Left> forecast;  // course.h
  std::optional<Left> left() const;

  bool operator==(const Progress&) const = default;
};

}  // namespace mars::events
