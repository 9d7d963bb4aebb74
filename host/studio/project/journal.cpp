#include "host/studio/project/journal.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <ctime>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "hal/failure/explain.h"
#include "host/content/document/checksum.h"
#include "host/content/document/file.h"
#include "host/content/document/json_file.h"
#include "host/content/document/recorded_reads.h"
#include "host/content/document/whole_file.h"

namespace mars::studio {
namespace {

using document::Json;

constexpr std::size_t kLargestStart = std::size_t{4} << 20;       // a longer text is known by its checksum alone
constexpr std::size_t kLongestJournal = 3 * History::kMostBytes;  // bytes of a journal
constexpr int kFormat = 1;

std::string checksum_of(const std::string& text) { return document::checksum_of(std::as_bytes(std::span(text))); }

std::string line_of(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n"; }

std::string first_line(const std::string& text) {
  Json json{{"mars-journal", kFormat}, {"is", checksum_of(text)}};
  if (text.size() <= kLargestStart) json["text"] = text;
  return line_of(json);
}

std::string step_line(const HistoryEntry& entry, const std::string& before, const std::string& after) {
  return line_of({{"time", entry.time},
                  {"step", entry.name},
                  {"at", entry.change.at},
                  {"before", entry.change.before},
                  {"after", entry.change.after},
                  {"from", checksum_of(before)},
                  {"to", checksum_of(after)}});
}

std::string move_line(const char* what, const std::string& before, const std::string& after) {
  return line_of({{"time", time_now()}, {what, true}, {"from", checksum_of(before)}, {"to", checksum_of(after)}});
}

std::string text_in(const Json& line, const char* key) {
  const auto found = line.find(key);
  return found != line.end() && found->is_string() ? found->get<std::string>() : "";
}

std::optional<HistoryEntry> entry_in(const Json& line) {
  const auto at = line.find("at");
  if (!line.contains("step") || at == line.end() || !at->is_number_unsigned()) return std::nullopt;
  return HistoryEntry{text_in(line, "time"),
                      text_in(line, "step"),
                      {at->get<std::size_t>(), text_in(line, "before"), text_in(line, "after")}};
}

// Reads lines one after another: what they made of the file.
class Replay {
 public:
  explicit Replay(std::string checksum = "") : is_(checksum), was_(std::move(checksum)) {}

  void take(const Json& line) {
    if (!line.is_object()) return;
    if (line.contains("mars-journal")) return begin(line);
    const std::string from = text_in(line, "from"), to = text_in(line, "to");
    if (from.empty() || to.empty()) return;
    if (!go_to(from)) forget(from);
    was_ = is_;
    is_ = to;
    cut_.clear();
    if (auto entry = entry_in(line))
      step(std::move(*entry));
    else if (line.contains("undo"))
      undo();
    else if (line.contains("redo"))
      redo();
    else
      way_ = Way::none;
  }

  // Whether the file can be in this state: the last line's, or the one before, where the last did not come true.
  bool go_to(const std::string& checksum) {
    if (is_ == checksum) return true;
    if (was_ != checksum) return false;
    switch (std::exchange(way_, Way::none)) {
      case Way::step:
        follow(&TextChange::undone, history_.entries().empty() ? TextChange{} : history_.entries().back().change);
        history_.take_back(std::exchange(cut_, {}));
        break;
      case Way::undo: redo(); break;
      case Way::redo: undo(); break;
      case Way::none: break;
    }
    way_ = Way::none;
    is_ = was_;
    return true;
  }

  History take_history() { return std::move(history_); }

  // What the file is after the last line, where that can be known.
  std::optional<std::string> text() const { return text_ && checksum_of(*text_) == is_ ? text_ : std::nullopt; }

 private:
  enum class Way { none, step, undo, redo };

  void begin(const Json& line) {
    forget(text_in(line, "is"));
    if (line.contains("text")) text_ = text_in(line, "text");
  }

  void forget(const std::string& checksum) { *this = Replay(checksum); }

  void step(HistoryEntry entry) {
    follow(&TextChange::done, entry.change);
    cut_ = history_.add(std::move(entry));
    way_ = Way::step;
  }

  void undo() {
    way_ = history_.to_undo() ? Way::undo : Way::none;
    if (way_ == Way::none) return;
    follow(&TextChange::undone, history_.to_undo()->change);
    history_.undo();
  }

  void redo() {
    way_ = history_.to_redo() ? Way::redo : Way::none;
    if (way_ == Way::none) return;
    follow(&TextChange::done, history_.to_redo()->change);
    history_.redo();
  }

  void follow(std::optional<std::string> (TextChange::*way)(std::string_view) const, const TextChange& change) {
    if (text_) text_ = (change.*way)(*text_);
  }

  History history_;
  std::string is_, was_;             // checksums: now, and before the last line
  Way way_ = Way::none;              // of the last line
  std::vector<HistoryEntry> cut_;    // by it
  std::optional<std::string> text_;  // where it is known
};

// The lines of a journal with just this history, which ends in a file of this text.
std::string written_anew(const History& history, const std::string& text) {
  std::string now = text;
  for (std::size_t i = history.done(); i-- > 0;) now = history.entries()[i].change.undone(now).value();
  std::string lines = first_line(now), undone;
  for (std::size_t i = 0; i < history.entries().size(); ++i) {
    const HistoryEntry& entry = history.entries()[i];
    std::string next = entry.change.done(now).value();
    lines += step_line(entry, now, next);
    if (i >= history.done()) undone.insert(0, move_line("undo", next, now));
    now = std::move(next);
  }
  return lines + undone;
}

// One write, whatever becomes of this process; a line that was torn before is ended first.
void append_to(const std::filesystem::path& path, std::string line, mode_t mode) {
  const int file = open(path.c_str(), O_RDWR | O_APPEND | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, mode);
  if (file < 0) document::fail_file("write", path, errno);
  const off_t size = lseek(file, 0, SEEK_END);
  char last = '\n';
  if (size > 0 && pread(file, &last, 1, size - 1) == 1 && last != '\n') line.insert(0, 1, '\n');
  const ssize_t written = ::write(file, line.data(), line.size());
  const int error = written < 0 ? errno : ENOSPC;
  close(file);
  if (written != static_cast<ssize_t>(line.size())) document::fail_file("write", path, error);
}

}  // namespace

std::string time_now() {
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  std::tm parts{};
  gmtime_r(&now, &parts);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text;
}

Journal::Journal(const std::filesystem::path& file)
    : file_(file), path_(file.parent_path() / ("." + file.filename().string() + ".journal")) {}

std::optional<History> Journal::read(const std::string& text) try {
  begin_ = true;
  const document::UnrecordedReads apart;  // it is none of the files that make the film
  const std::optional<std::string> lines = document::read_file_if_there(path_, 2 * kLongestJournal);
  if (!lines) return std::nullopt;
  Replay replay;
  for (std::size_t at = 0; at < lines->size();) {
    const std::size_t end = std::min(lines->find('\n', at), lines->size());
    replay.take(Json::parse(lines->begin() + static_cast<std::ptrdiff_t>(at),
                            lines->begin() + static_cast<std::ptrdiff_t>(end), nullptr, false));
    at = end + 1;
  }
  const bool accounts = replay.go_to(checksum_of(text));
  const std::optional<std::string> last = replay.text();
  if (!accounts && !last) return std::nullopt;
  begin_ = false;
  History history = replay.take_history();
  if (accounts) return history;
  HistoryEntry entry{time_now(), kChangedOutside, change_between(*last, text)};
  write_step(entry, *last, text);
  history.add(std::move(entry));
  return history;
} catch (const std::exception& failure) {
  trouble_ = reason_of(failure);
  return std::nullopt;
}

void Journal::write_step(const HistoryEntry& entry, const std::string& before, const std::string& after) {
  append(step_line(entry, before, after), before);
}

void Journal::write_undo(const std::string& before, const std::string& after) {
  append(move_line("undo", before, after), before);
}

void Journal::write_redo(const std::string& before, const std::string& after) {
  append(move_line("redo", before, after), before);
}

void Journal::append(const std::string& line, const std::string& before) try {
  struct stat file {};
  const mode_t mode = stat(file_.c_str(), &file) == 0 ? file.st_mode & 0666 : 0666;
  std::error_code none;
  if (!std::filesystem::exists(path_, none)) begin_ = true;
  append_to(path_, begin_ ? first_line(before) + line : line, mode);
  begin_ = false;
  trouble_.clear();
} catch (const std::exception& failure) {
  trouble_ = reason_of(failure);
}

void Journal::shorten(const History& history, const std::string& text) try {
  constexpr std::uintmax_t kUsual = std::uintmax_t{2} << 20;
  std::error_code none;
  const std::uintmax_t size = std::filesystem::file_size(path_, none);
  if (none || size <= kUsual + 3 * (history.bytes() + std::min(text.size(), kLargestStart))) return;
  const std::string lines = written_anew(history, text);
  document::replace_file(path_, path_.string() + "." + document::unique_word() + std::string(document::kPartSuffix),
                         std::as_bytes(std::span(lines)));
} catch (const std::exception& failure) {
  trouble_ = reason_of(failure);
}

}  // namespace mars::studio
