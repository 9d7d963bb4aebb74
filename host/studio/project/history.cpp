#include "host/studio/project/history.h"

#include <iterator>
#include <utility>

namespace mars::studio {

std::vector<HistoryEntry> History::add(HistoryEntry entry) {
  const auto undone = entries_.begin() + static_cast<std::ptrdiff_t>(done_);
  std::vector<HistoryEntry> cut(std::make_move_iterator(undone), std::make_move_iterator(entries_.end()));
  entries_.erase(undone, entries_.end());
  for (const HistoryEntry& each : cut) bytes_ -= each.change.bytes();
  bytes_ += entry.change.bytes();
  entries_.push_back(std::move(entry));
  ++done_;
  forget_oldest();
  return cut;
}

void History::take_back(std::vector<HistoryEntry> redone) {
  if (!entries_.empty()) {  // else it was forgotten at once
    bytes_ -= entries_.back().change.bytes();
    entries_.pop_back();
    --done_;
  }
  for (HistoryEntry& each : redone) {
    bytes_ += each.change.bytes();
    entries_.push_back(std::move(each));
  }
}

void History::undo() {
  if (done_ > 0) --done_;
}

void History::redo() {
  if (done_ < entries_.size()) ++done_;
}

void History::forget_oldest() {
  std::size_t forgotten = 0;
  while (entries_.size() - forgotten > kMostEntries || bytes_ > kMostBytes)
    bytes_ -= entries_[forgotten++].change.bytes();
  entries_.erase(entries_.begin(), entries_.begin() + static_cast<std::ptrdiff_t>(forgotten));
  done_ -= forgotten;
}

}  // namespace mars::studio
