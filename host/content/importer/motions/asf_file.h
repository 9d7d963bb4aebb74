// ASF and AMC, Acclaim's files: a skeleton whose bones have a direction, a length, axes, degrees of freedom with
// limits; and its motions. A bone's numbers turn it about its own axes C, the first letter of its axes' order
// innermost: L = C M C^-1, and its frame is its parent's times L.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "host/content/importer/motions/skeleton.h"

namespace mars::importer {

// Where a number of a bone's line in an AMC goes.
struct AcclaimNumber {
  bool turns = false, moves = false;  // neither: a length, which joints cannot change
  int part = 0;                       // of the pose, or axis of the root's place
  double sign = 1;
};

struct AsfFile {
  Skeleton skeleton;                                // joint 0 is the root
  std::vector<std::vector<AcclaimNumber>> numbers;  // by joint, in the order of its line
  bool degrees = true;                              // of motions that do not say it
  std::vector<std::string> not_read;                // "2 bones' change of length"
};

// Limits become limits of joints: the same numbers about the same axes. Failures are at FILE:LINE.
AsfFile read_asf(const std::filesystem::path& path);

// A motion of the skeleton, at `rate` frames a second, which the file does not say. A bone that a frame leaves out
// stays as it was in the frame before.
Motion read_amc(const std::filesystem::path& path, const AsfFile& skeleton, double rate);

}  // namespace mars::importer
