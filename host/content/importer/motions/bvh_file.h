// BVH, Biovision's files of a skeleton and its motion: each joint has an offset from its parent and a list of channels,
// and a frame is a line of numbers, one a channel. A joint's turns go in the order of its channels, the first
// outermost: R = R(first) R(second) R(third).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "host/content/importer/motions/skeleton.h"

namespace mars::importer {

struct BvhFile {
  Skeleton skeleton;
  Motion motion;                      // without frames where the file has none
  std::vector<std::string> remarks;   // what was made of numbers that can be read in two ways
  std::vector<std::string> not_read;  // "places of 2 joints, ..."
};

// Channels may come in any order. The root's positions are added to its OFFSET (Biovision), unless the first frame's
// are about equal to it, as motions of MotionBuilder and Blender are. Refuses several roots, and files that are not as
// they should be, in failures at FILE:LINE.
BvhFile read_bvh(const std::filesystem::path& path);

}  // namespace mars::importer
