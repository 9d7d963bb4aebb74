// The steps that made a file what it is, those that can be undone and those that were: one history, shared by all who
// work on the file. Values only; journal.h keeps it on the disk.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "host/studio/project/text_change.h"

namespace mars::studio {

struct HistoryEntry {
  std::string time;  // when it was done, UTC: "2026-01-31T12:00:00Z"
  std::string name;  // what it did: "turn left-knee"
  TextChange change;
};

class History {
 public:
  // Entries beyond these, the oldest first, are forgotten.
  static constexpr std::size_t kMostEntries = 1000;
  static constexpr std::size_t kMostBytes = std::size_t{16} << 20;

  const HistoryEntry* to_undo() const { return done_ > 0 ? &entries_[done_ - 1] : nullptr; }
  const HistoryEntry* to_redo() const { return done_ < entries_.size() ? &entries_[done_] : nullptr; }

  // What was undone before cannot be redone any more: it is returned.
  std::vector<HistoryEntry> add(HistoryEntry entry);
  // As if the last entry had never been added; `redone`: what add() returned.
  void take_back(std::vector<HistoryEntry> redone);
  void undo();  // the last that is done; nothing where there is none
  void redo();

  const std::vector<HistoryEntry>& entries() const { return entries_; }
  std::size_t done() const { return done_; }    // entries that are done
  std::size_t bytes() const { return bytes_; }  // of their changes

 private:
  void forget_oldest();

  std::vector<HistoryEntry> entries_;
  std::size_t done_ = 0;
  std::size_t bytes_ = 0;
};

}  // namespace mars::studio
