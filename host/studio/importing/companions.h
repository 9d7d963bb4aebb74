// Files that an import's files name, but that did not come with them: a person may still bring them.
#pragma once

#include <string>
#include <vector>

#include "host/studio/importing/import_request.h"
#include "host/studio/importing/upload_folder.h"

namespace mars::studio {

struct Companion {
  std::string name;  // where it belongs in the import's folder: "tex/skin.png"; "*.asf": any of this ending
  std::string of;    // the file that names it
  bool needed;       // nothing can be made without it
};

// Buffers of glTF files and pictures of their colours, colours of OBJ files, skeletons of AMC files. A file that came
// under the right name in another folder is put to where it belongs. Files of over 1 MiB are not looked at: their
// reader says what they lack. Throws Failure where more are missing than one import takes.
std::vector<Companion> missing_companions(const UploadFolder& folder, const ImportRequest& request,
                                          const std::vector<ImportJob>& jobs);

// "soldier.bin and skin.png", for a person.
std::string names_of(const std::vector<Companion>& companions);

}  // namespace mars::studio
