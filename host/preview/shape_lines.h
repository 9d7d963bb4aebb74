// The lines of one thing in its own coordinates: a control net, a prism, a joint's sticks (thesis, figure 2.6).
#pragma once

#include <span>
#include <vector>

#include "host/content/modeler/model.h"
#include "host/preview/lines.h"
#include "node/wire/film.h"

namespace mars::preview {

// The control points of a shape's patches, joined along u and v, and the vertices of its meshes, joined along edges.
// Each point and each line once; lines of no length are left out. All points are dots.
Lines control_net(const wire::PackedFilm& film, const wire::Shape& shape);
// Of patches without a skin.
Lines control_net(std::span<const wire::Patch> patches);

// The 12 edges of the unit cube, which a T-matrix makes a segment's prism.
Lines cube_edges();

// Of a skin: the edges of a prism for each bone, round the points that follow it more than others. They go with it.
Lines bone_prisms(const wire::PackedFilm& film, const wire::Shape& shape);

// The middle of the unit cube's low face to that of the high one along `axis`.
Lines cube_axis(int axis);

// Of each joint: from it (a dot) to each of its children; from the last of a limb to the far end of its rigid segment.
// In the unit cube of the joint's segment, or in the joint's own frame where it has none.
std::vector<Lines> sticks_of(const modeler::Model& model);

}  // namespace mars::preview
