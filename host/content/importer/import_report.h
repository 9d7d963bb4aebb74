// What `mars import` prints at its end: what of the file was read, and what was not.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "host/content/document/long_text.h"
#include "host/content/importer/imported_mesh.h"

namespace mars::importer {

struct ImportReport {
  std::string model;                  // "model of one joint 'rock'"
  std::string box;                    // what the shape takes up: "2 x 4 x 6, ..."
  std::vector<std::string> read;      // "8 vertices", ...
  std::vector<std::string> made;      // of it besides meshes: "joints of 4 nodes", ...
  std::vector<std::string> kept;      // for the day when surfaces show it: "2 images in rock-images", ...
  std::vector<std::string> not_read;  // "19 bones", ...; none: all was read
};

struct ImportedText {
  ImportReport report;
  document::LongText text;  // of the model or the film
  std::vector<KeptImage> images{};
};

// In lines, the first beginning with the file that was written.
std::string text_of(const ImportReport& report, const std::string& written);

}  // namespace mars::importer
