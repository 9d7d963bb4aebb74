#include "host/preview/folder_pictures.h"

#include "hal/failure/failure.h"
#include "host/content/document/shell_word.h"
#include "host/images/picture_file.h"
#include "host/preview/pose_keys.h"
#include "host/render/sinks/frame_mark.h"

namespace mars::preview {

FolderPictures::FolderPictures(std::filesystem::path folder)
    : folder_(std::move(folder)), manifest_(sinks::read_manifest(folder_)) {
  if (images::is_exr(manifest_.format))
    throw Failure("its frames are EXR files: light, not yet exposed or encoded to be seen", folder_.string(),
                  "render the film with --format png into another folder, or preview the film itself");
}

SharedImage FolderPictures::picture(std::uint32_t place, images::PictureSize extent) {
  const std::filesystem::path file = folder_ / sinks::frame_file_name(manifest_, manifest_.frames.at(place));
  if (!sinks::is_frame_file(file))
    throw Failure("frame " + std::to_string(manifest_.frames.at(place)) + " is missing", folder_.string(),
                  "mars verify --repair " + document::shell_word(folder_.string()) + " renders it again");
  return std::make_shared<const images::Image>(scaled(images::read_opaque(file), fitted(this->extent(), extent)));
}

bool FolderPictures::handle_key(const KeyPress& key, std::uint32_t) {
  note_ = is_pose_key(key) ? "rendered frames have no joints to pose: preview their film" : "";
  return is_pose_key(key);
}

}  // namespace mars::preview
