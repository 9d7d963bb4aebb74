#include "host/content/importer/image_writer.h"

#include <string>

#include "hal/failure/failure.h"
#include "host/content/document/file.h"
#include "host/content/document/whole_file.h"

namespace mars::importer {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kLargestImage = std::uintmax_t{1} << 30;

bool has_bytes(const fs::path& file, std::string_view bytes) {
  std::error_code error;
  return fs::is_regular_file(file, error) && fs::file_size(file, error) == bytes.size() && !error &&
         document::read_file(file, kLargestImage) == bytes;
}

}  // namespace

ImageWriter::~ImageWriter() {
  std::error_code ignored;
  for (auto each = made_.rbegin(); each != made_.rend(); ++each) fs::remove(*each, ignored);
}

void ImageWriter::make_folder(const fs::path& folder) {
  std::error_code error;
  if (fs::create_directory(folder, error)) made_.push_back(folder);
  if (!fs::is_directory(folder, error))
    throw Failure("is no folder, and the images of the model are to lie in it", folder.string(),
                  "move it away, or choose another name for the model");
}

void ImageWriter::write(const ImageToWrite& image) {
  const fs::path to = folder_ / image.file;
  make_folder(to.parent_path());
  std::string copied;
  if (!image.from.empty()) copied = document::read_file(image.from, kLargestImage);
  const std::string_view bytes = image.from.empty() ? image.bytes : std::string_view(copied);
  if (has_bytes(to, bytes)) return;
  std::error_code none;
  const bool is_there = fs::exists(fs::symlink_status(to, none));
  if (is_there && !force_)
    throw Failure("is there already, with another image", to.string(),
                  "choose another name for the model, or replace it with --force");
  document::write_whole_file(to, bytes);
  if (!is_there) made_.push_back(to);
}

}  // namespace mars::importer
