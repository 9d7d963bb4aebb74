// The film file in which poses become keys, as `mars animate FILM pose` makes them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "host/content/animator/pose/within_limits.h"
#include "host/preview/pose_under_way.h"

namespace mars::preview {

class KeyFile {
 public:
  explicit KeyFile(std::filesystem::path path) : path_(std::move(path)) {}

  // Keys of the pose at the frame; remarks as animator::pose(). Throws Failure; the file is then as it was.
  animator::Remarks set(const PoseUnderWay& pose, std::uint32_t frame);
  // Takes back what set() wrote last and has not been taken back: the file is byte for byte as before. False: there is
  // no more. Throws Failure where somebody else has changed the file since.
  bool undo();

 private:
  struct Change {
    std::string before, after;
  };

  std::filesystem::path path_;
  std::vector<Change> changes_;
};

}  // namespace mars::preview
