// The words of POV-Ray's scene description language.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace mars::importer {

enum class PovKind { word, directive, number, text, sign, end };

struct PovWord {
  PovKind kind = PovKind::end;
  std::string text;  // of a directive without its #, of a text without its quotation marks
  double number = 0;
  std::size_t line = 1;
  std::size_t file = 0;  // of PovText

  bool is(PovKind what, std::string_view word) const { return kind == what && text == word; }
};

struct PovText {
  std::vector<PovWord> words;  // without comments; the last is the end
  std::vector<std::string> files;

  std::string place_of(const PovWord& word) const { return files[word.file] + ":" + std::to_string(word.line); }
};

// All of a file. Files that it includes stand in the place of their names; names of files that are not there, as of
// POV-Ray's own, stay as words. An included file lies beside the one that includes it or beside the first; outside of
// the first one's folder it is refused (sources/companion.h). Failures are at FILE:LINE.
PovText pov_text(const std::filesystem::path& path);

}  // namespace mars::importer
