// A film's frames for the tasks of an array of jobs.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "host/content/film/frame_set.h"
#include "host/render/farm/plan.h"

namespace mars::batch {

// At most `count` parts of about as many frames each. No interval is in two parts: each task of `tasks` (make_tasks)
// goes to one, so that no keyframe is drawn twice.
std::vector<film::FrameSet> array_parts(std::span<const farm::Task> tasks, std::size_t count);

}  // namespace mars::batch
