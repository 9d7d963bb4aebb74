// What `mars import` prints at its end: what of the file was read, and what was not.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace mars::host {

struct ImportReport {
  std::string model;                  // "model of one joint 'rock'"
  std::string box;                    // what the shape takes up: "2 x 4 x 6, ..."
  std::vector<std::string> read;      // "8 vertices", ...
  std::vector<std::string> not_read;  // "19 bones", ...; none: all was read
};

// In lines, the first beginning with the file that was written.
std::string text_of(const ImportReport& report, const std::string& written);

// "1 face", "2 faces".
std::string counted(std::size_t count, std::string_view one, std::string_view several);

// Of a file's bytes what can be printed; '?' for others.
std::string printable(std::string_view text);

}  // namespace mars::host
