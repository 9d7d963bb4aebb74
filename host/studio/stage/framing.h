// What a view is to show whole: everything that the film is about, or what a page has selected.
#pragma once

#include "host/studio/stage/moments.h"
#include "host/studio/stage/selected.h"

namespace mars::studio {

// Round the selected figure, or the joint's own segment (of a joint without one, all below it), or about a mark; of
// nothing, round the subject.
preview::Ball ball_of(const Project& project, const Moments& moments, const Selection& selection);

}  // namespace mars::studio
