#include "host/preview/folder_pictures.h"

namespace mars::preview {

FolderPictures::FolderPictures(std::filesystem::path folder)
    : folder_(std::move(folder)), manifest_(sinks::read_manifest(folder_)) {}

SharedImage FolderPictures::picture(std::uint32_t place, images::PictureSize extent) {
  const std::filesystem::path file =
      folder_ / sinks::frame_file_name(manifest_.frames.at(place), manifest_.film_frames);
  return std::make_shared<const images::Image>(scaled(images::read_png(file), fitted(this->extent(), extent)));
}

}  // namespace mars::preview
