#include "host/shell/launch/hostfile.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "hal/failure/failure.h"
#include "host/content/document/file.h"
#include "host/content/document/text.h"

namespace mars::launch {
namespace {

constexpr std::size_t kLongestName = 255;     // bytes
constexpr std::uintmax_t kLargest = 1 << 26;  // bytes
constexpr const char* kForm = "write a line a host, like: n1 slots=4";
constexpr std::string_view kHostfileSpace = " \t\v\f";
constexpr std::string_view kLetters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-.,:*@+=";

constexpr std::array<std::string_view, 3> kSlots = {"slots", "cpu", "count"};
constexpr std::array<std::string_view, 8> kMostOfSlots = {"max_slots", "max-slots", "slots_max", "slots-max",
                                                          "max_cpu",   "max-cpu",   "cpu_max",   "cpu-max"};
constexpr std::array<std::string_view, 4> kMostOfCount = {"max_count", "max-count", "count_max", "count-max"};
constexpr std::array<std::string_view, 3> kUser = {"username", "user_name", "user-name"};
constexpr std::array<std::string_view, 13> kOthers = {
    "rank", "slot",  "boards",  "sockets",          "sockets_per_board", "sockets-per-board",
    "port", "cores", "cpu_set", "cores_per_socket", "cores-per-socket",  "cpu-set",
    "cpus"};

template <typename Words>
bool is_one_of(const Words& words, std::string_view word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

bool is_most(std::string_view word) { return is_one_of(kMostOfSlots, word) || is_one_of(kMostOfCount, word); }

bool is_key(std::string_view word) {
  return is_one_of(kSlots, word) || is_most(word) || is_one_of(kUser, word) || is_one_of(kOthers, word);
}

// Each "/* ... */" becomes blanks and the ends of its lines.
std::string without_blocks(std::string text) {
  for (std::size_t at = 0; at < text.size(); ++at) {
    const bool line = text[at] == '#' || text.compare(at, 2, "//") == 0;
    if (line) at = std::min(text.find('\n', at), text.size());
    if (line || text.compare(at, 2, "/*") != 0) continue;
    const std::size_t end = std::min(text.find("*/", at + 2), text.size() - 2) + 2;
    for (; at < end; ++at)
      if (text[at] != '\n') text[at] = ' ';
  }
  return text;
}

class Line {
 public:
  // Throws Failure where it holds what no hostfile does.
  Line(std::string_view text, std::string where) : where_(std::move(where)) {
    text = text.substr(0, std::min(text.find('#'), text.find("//")));
    if (text.ends_with('\r')) refuse("ends as a line of Windows", "convert the file: dos2unix FILE");
    for (const char letter : text)
      if (kHostfileSpace.find(letter) == std::string_view::npos && kLetters.find(letter) == std::string_view::npos)
        refuse("has a character that no hostfile has: '" + std::string(1, letter) + "'", kForm);
    split(text);
  }

  bool is_empty() const { return words_.empty(); }
  bool is_relative() const { return words_.front().starts_with('+'); }

  Slots slots() {
    if (next_is("rank")) return slots_of_rank();
    Slots slots{host(take()), 1};
    std::optional<std::uint32_t> count, most;
    while (at_ < words_.size()) read_next(slots.host, count, most);
    slots.count = count ? *count : most.value_or(1);
    gives_slots_ = count.has_value();
    return slots;
  }

  bool gives_slots() const { return gives_slots_; }
  const std::string& where() const { return where_; }

  [[noreturn]] void refuse(const std::string& problem, const std::string& remedy) const {
    throw Failure(problem, where_, remedy);
  }

 private:
  // At blanks; "=" is a word of its own.
  void split(std::string_view text) {
    while (true) {
      text.remove_prefix(std::min(text.find_first_not_of(kHostfileSpace), text.size()));
      if (text.empty()) return;
      const std::size_t end = text.front() == '=' ? 1 : std::min(text.find_first_of(" \t\v\f="), text.size());
      words_.emplace_back(text.substr(0, end));
      text.remove_prefix(end);
    }
  }

  bool next_is(std::string_view word) const { return at_ < words_.size() && words_[at_] == word; }
  std::string take() { return at_ < words_.size() ? words_[at_++] : ""; }

  // As it is written: ssh takes the user too.
  std::string host(const std::string& word) const {
    if (word.empty() || word == "=" || is_key(word)) refuse("names no host", kForm);
    if (word.size() > kLongestName) refuse("is no host's name: it is too long", kForm);
    if (word.find(',') != std::string::npos || std::count(word.begin(), word.end(), '@') > 1)
      refuse("'" + word + "' is not the name of one host", kForm);
    const std::size_t colon = word.find(':');
    if (colon != std::string::npos && word.find(':', colon + 1) == std::string::npos)
      refuse("'" + word + "' is no host's name",
             "write: " + word.substr(0, colon) + " slots=" + word.substr(colon + 1));
    return word;
  }

  // "rank 0=n1 slot=1", as in a rankfile: mpirun counts a slot.
  Slots slots_of_rank() {
    while (at_ < words_.size() && !next_is("=")) ++at_;
    take();
    const Slots slots{host(take()), 1};
    at_ = words_.size();
    return slots;
  }

  void read_next(const std::string& host, std::optional<std::uint32_t>& count, std::optional<std::uint32_t>& most) {
    const std::string word = take();
    if (is_one_of(kUser, word)) {
      if (next_is("=")) take();
      take();
    } else if (is_one_of(kSlots, word)) {
      if (count) refuse("gives the slots of " + host + " twice", kForm);
      count = number_after(word);
    } else if (is_most(word)) {
      most = number_after(word);
      if (*most == 0 || *most < count.value_or(0))
        refuse(word + " is " + std::to_string(*most) + ", less than slots", "leave it out, or write slots or more");
    } else if (word == "port") {
      number_after(word);
    } else if (word == "=" || next_is("=") || is_key(word)) {
      refuse("'" + word + "' is no word of a hostfile", kForm);
    } else if (word.starts_with('+') || word.find('.') != std::string::npos) {
      refuse("names a second host, " + word, kForm);
    }
  }

  std::uint32_t number_after(const std::string& word) {
    const bool given = next_is("=");
    if (given) take();
    const std::string digits = given ? take() : "";
    if (digits.empty() || digits.find_first_not_of("0123456789") != std::string::npos)
      refuse(word + " has no number", kForm);
    const auto number = document::number_in<std::uint32_t>(digits);
    if (!number || *number > kMostSlots) refuse(word + " is " + digits + ", more than any machine has", kForm);
    return *number;
  }

  std::string where_;
  std::vector<std::string> words_;
  std::size_t at_ = 0;
  bool gives_slots_ = false;
};

void add(std::vector<Slots>& hosts, const Slots& slots, const Line& line) {
  const auto known = std::ranges::find(hosts, slots.host, &Slots::host);
  if (known == hosts.end()) return hosts.push_back(slots);
  if (line.gives_slots()) line.refuse("gives the slots of " + slots.host + " again", kForm);
  known->count += slots.count;
}

// Open MPI's reader needs an end of each comment's line.
void check_last_comment(std::string_view line, const std::string& where) {
  if (line.find('#') != std::string_view::npos || line.find("//") != std::string_view::npos)
    throw Failure("the file ends within a comment", where, "end its last line");
}

}  // namespace

std::vector<Slots> read_hostfile(const std::filesystem::path& hostfile) {
  const std::string text = without_blocks(document::read_file(hostfile, kLargest));
  std::vector<Slots> hosts;
  bool relative = false;
  std::string_view rest = text;
  for (int number = 1; !rest.empty(); ++number) {
    const std::string where = hostfile.string() + ":" + std::to_string(number);
    const std::size_t end = rest.find('\n');
    if (end == std::string_view::npos) check_last_comment(rest, where);
    Line line(rest.substr(0, end), where);
    rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
    if (line.is_empty()) continue;
    if (line.is_relative())
      relative = true;
    else
      add(hosts, line.slots(), line);
  }
  if (relative) return {};
  if (hosts.empty()) throw Failure("names no host", hostfile.string(), kForm);
  // Where no host has slots, ranks go round over all of them.
  const bool none = std::ranges::all_of(hosts, [](const Slots& slots) { return slots.count == 0; });
  if (none) std::ranges::for_each(hosts, [](Slots& slots) { slots.count = 1; });
  std::erase_if(hosts, [](const Slots& slots) { return slots.count == 0; });
  return hosts;
}

}  // namespace mars::launch
