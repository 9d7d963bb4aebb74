// A film's frames for the tasks of an array of jobs.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "host/content/film/frame_set.h"
#include "host/render/farm/plan.h"
#include "host/render/farm/rough_work.h"

namespace mars::batch {

struct ArrayParts {
  std::vector<film::FrameSet> frames;
  double more_work = 0;  // of all parts, as a share of what one job would do: keyframes within intervals
};

// At most `count` parts of about equal work, `works[i]` for frames of `tasks[i]` (make_tasks). They are cut where
// intervals begin if the longest then takes at most a tenth longer than it must. A part that begins within an interval
// draws a keyframe of its own there.
ArrayParts array_parts(std::span<const farm::Task> tasks, std::span<const farm::RoughWork> works, std::size_t count);

}  // namespace mars::batch
