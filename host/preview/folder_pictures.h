// Rendered frames in a folder (host/render/sinks/frame_folder.h), as they are rendered or later.
#pragma once

#include <filesystem>
#include <vector>

#include "host/preview/pictures.h"
#include "host/videos/folder_source.h"

namespace mars::preview {

class FolderPictures : public Pictures {
 public:
  // As FolderReader.
  explicit FolderPictures(const std::filesystem::path& folder, const videos::Exposing& exposing = {});

  const videos::FolderReader& reader() const { return reader_; }
  std::uint32_t frames() const override { return static_cast<std::uint32_t>(manifest().frames.size()); }
  double rate() const override { return manifest().rate; }
  // Of square pixels, as they are shown.
  images::PictureSize extent() const override;
  // By its place among the folder's frames, from 0. Throws Failure where its file is missing or torn.
  SharedImage picture(std::uint32_t place, images::PictureSize extent) override;
  // Refuses keys for posing.
  bool handle_key(const KeyPress& key, std::uint32_t frame) override;
  std::string note(std::uint32_t) const override { return note_; }
  std::string state() const override { return reader_.folder().string(); }

 private:
  const sinks::Manifest& manifest() const { return reader_.manifest(); }

  videos::FolderReader reader_;
  std::string note_;
};

}  // namespace mars::preview
