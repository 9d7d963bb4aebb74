// The history of a file, beside it in .NAME.journal: one JSON object a line, each written at once. The first line says
// what the file was when the journal began; each other what was done, undone or redone, and the checksums of the file
// before and after. A line is written before the file is: so a line whose effect never came to the file is known by its
// checksums, and left out.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

#include "host/studio/project/history.h"

namespace mars::studio {

inline constexpr const char* kChangedOutside = "changed outside";

class Journal {
 public:
  explicit Journal(const std::filesystem::path& file);

  // The history of the file, which has this text. What others did to it since the journal was written is an entry
  // "changed outside", which is in the journal then. None where the journal is missing, or knows nothing of such a
  // file: then it begins again with the next line.
  std::optional<History> read(const std::string& text);

  // Before the file is written. Where the journal cannot be written, `trouble()` says why, and work goes on without.
  void write_step(const HistoryEntry& entry, const std::string& before, const std::string& after);
  void write_undo(const std::string& before, const std::string& after);
  void write_redo(const std::string& before, const std::string& after);

  // Writes it again where it is much longer than the history, which ends in a file of this text.
  void shorten(const History& history, const std::string& text);

  const std::filesystem::path& path() const { return path_; }
  const std::string& trouble() const { return trouble_; }

 private:
  void append(const std::string& line, const std::string& before);

  std::filesystem::path file_, path_;
  std::string trouble_;
  bool begin_ = true;  // with a first line
};

std::string time_now();

}  // namespace mars::studio
