// Rendered frames in a folder (host/render/sinks/frame_folder.h), as they are rendered or later.
#pragma once

#include <filesystem>
#include <vector>

#include "host/preview/pictures.h"
#include "host/render/sinks/frame_folder.h"

namespace mars::preview {

class FolderPictures : public Pictures {
 public:
  // Throws Failure where the folder has no manifest, or has EXR files.
  explicit FolderPictures(std::filesystem::path folder);

  std::uint32_t frames() const override { return static_cast<std::uint32_t>(manifest_.frames.size()); }
  double rate() const override { return manifest_.rate; }
  images::PictureSize extent() const override { return {manifest_.width, manifest_.height}; }
  // By its place among the folder's frames, from 0. Throws Failure where its file is missing or torn.
  SharedImage picture(std::uint32_t place, images::PictureSize extent) override;
  // Refuses keys for posing.
  bool handle_key(const KeyPress& key, std::uint32_t frame) override;
  std::string note(std::uint32_t) const override { return note_; }
  std::string state() const override { return folder_.string(); }

 private:
  std::filesystem::path folder_;
  sinks::Manifest manifest_;
  std::string note_;
};

}  // namespace mars::preview
