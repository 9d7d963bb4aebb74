// Writes the images of an imported model beside it, before the model itself, which names them.
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

namespace mars::importer {

struct ImageToWrite {
  std::string_view file;  // as seen from the model's folder: "rock-images/stone.png"
  std::string_view bytes;
  std::filesystem::path from;  // where it is a copy of a file
};

class ImageWriter {
 public:
  // `force`: other files under the images' names may be there, and are replaced.
  ImageWriter(const std::filesystem::path& model, bool force) : folder_(model.parent_path()), force_(force) {}
  // Removes the files and folders that it made and that were not there before, unless keep() was called.
  ~ImageWriter();
  ImageWriter(const ImageWriter&) = delete;
  ImageWriter& operator=(const ImageWriter&) = delete;

  // Whole or not at all. A file with the same bytes stays as it is; throws Failure where there is another.
  void write(const ImageToWrite& image);
  void keep() { made_.clear(); }

 private:
  void make_folder(const std::filesystem::path& folder);

  std::filesystem::path folder_;
  bool force_;
  std::vector<std::filesystem::path> made_;
};

}  // namespace mars::importer
