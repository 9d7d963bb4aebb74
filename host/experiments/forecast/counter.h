// Who counts frames for a forecast: nodes' code, which only programs link.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>

#include "host/render/farm/plan.h"
#include "node/wire/frame_counts.h"

namespace mars::forecast {

class Counter {
 public:
  virtual ~Counter() = default;

  virtual wire::FrameCounts count_keyframe(const farm::Task& task) = 0;
  // Of the task whose keyframe was counted last.
  virtual wire::FrameCounts count_inbetween(std::uint32_t frame) = 0;
};

// How many lines of a frame are drawn to find what they show.
enum class Lines { some, all };

using MakeCounter = std::function<std::unique_ptr<Counter>(const wire::PackedFilm& film, Lines lines)>;

}  // namespace mars::forecast
