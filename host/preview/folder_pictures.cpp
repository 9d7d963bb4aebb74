#include "host/preview/folder_pictures.h"

namespace mars::host {

FolderPictures::FolderPictures(std::filesystem::path folder)
    : folder_(std::move(folder)), manifest_(read_manifest(folder_)) {}

SharedImage FolderPictures::picture(std::uint32_t place, PictureSize extent) {
  const std::filesystem::path file = folder_ / frame_file_name(manifest_.frames.at(place), manifest_.film_frames);
  return std::make_shared<const Image>(scaled(read_png(file), fitted(this->extent(), extent)));
}

}  // namespace mars::host
