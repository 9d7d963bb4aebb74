// The files of one import until a model is made of them: in a folder of their own beside the film, which only this user
// may enter, and which is gone at its end. So nothing that is half there has a name that a person gave it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "host/child/descriptor.h"
#include "host/content/document/held_folder.h"

namespace mars::studio {

class UploadFolder {
 public:
  // Throws Failure where no folder can be made in that one.
  explicit UploadFolder(const std::filesystem::path& beside);

  const std::filesystem::path& path() const { return folder_.path(); }
  // `name`: plain, "tex/skin.png".
  std::filesystem::path uploaded(const std::string& name) const { return folder_.path() / "from" / name; }
  // Where the import's run of this number puts what it makes; make_folder() makes it.
  std::filesystem::path folder_of(std::size_t run) const;
  std::filesystem::path make_folder(std::size_t run) const;

 private:
  document::HeldFolder folder_;
};

// Of studios that were killed.
void remove_abandoned_uploads(const std::filesystem::path& beside);

// A new file that is written piece by piece. Throws Failure where it is there already, or cannot be written.
class WrittenFile {
 public:
  explicit WrittenFile(std::filesystem::path path);
  void write(std::string_view piece);

 private:
  std::filesystem::path path_;
  child::Descriptor file_;
};

}  // namespace mars::studio
