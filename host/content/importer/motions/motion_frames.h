// A motion at the frames of a film, and what it asks of joints.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "host/content/importer/motions/skeleton.h"

namespace mars::importer {

// Frames a second of the file, where those are almost a whole number: 0.0083333 s are 120.
double whole_rate(double rate);

// Of a film of a motion: the file's, or where those are more than 30 and a multiple of 24, 25 or 30, the first such.
double kind_rate(double rate);

// At `rate` frames a second, from the first frame to the last one in it. A frame of the film that is one of the file
// has its numbers; between two of the file's, places go straight on, joints that turn about one or two axes by their
// numbers, others by the smallest turn.
Motion at_rate(std::span<const modeler::Joint> joints, const Motion& motion, double rate);

// Brings numbers of joints with -180 to 180 about several axes within these, by whole turns. Makes limits of others
// wider where the motion is outside; the names of the joints of which it did.
std::vector<std::string> fit_limits(std::vector<modeler::Joint>& joints, Motion& motion);

}  // namespace mars::importer
