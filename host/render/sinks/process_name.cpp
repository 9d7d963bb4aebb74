#include "host/render/sinks/process_name.h"

#include <signal.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>

#include "host/render/sinks/record.h"

namespace mars::sinks {

namespace {

std::string text_of(const std::string& file) {
  std::ifstream stream(file);
  return {std::istreambuf_iterator<char>(stream), {}};
}

struct ProcessState {
  char letter = 0;  // Z: ended, waits for its parent; X: gone
  std::uint64_t start = 0;
};

// None where there is no such process or it is hidden. The program's name, in parentheses, may hold anything.
std::optional<ProcessState> state_of(std::int64_t process) {
  constexpr int kFieldsBeforeStart = 18;  // between the state's letter and the start
  const std::string stat = text_of("/proc/" + std::to_string(process) + "/stat");
  const std::size_t name_end = stat.rfind(')');
  if (name_end == std::string::npos) return std::nullopt;
  std::istringstream fields(stat.substr(name_end + 1));
  ProcessState state;
  fields >> state.letter;
  std::string passed;
  for (int i = 0; i < kFieldsBeforeStart; ++i) fields >> passed;
  fields >> state.start;
  return fields ? std::optional(state) : std::nullopt;
}

}  // namespace

ProcessName this_process() {
  ProcessName own;
  utsname system{};
  if (uname(&system) == 0) own.host = system.nodename;
  own.boot = text_of("/proc/sys/kernel/random/boot_id");
  while (own.boot.ends_with('\n')) own.boot.pop_back();
  std::error_code none;
  own.processes = std::filesystem::read_symlink("/proc/self/ns/pid", none).string();
  own.number = getpid();
  if (const auto state = state_of(own.number)) own.start = state->start;
  return own;
}

nlohmann::json to_json(const ProcessName& process) {
  return {{"host", process.host},
          {"boot", process.boot},
          {"processes", process.processes},
          {"process", process.number},
          {"start", process.start}};
}

ProcessName process_name_of(const nlohmann::json& from) {
  constexpr std::size_t kLongestText = 255;  // bytes; a host's name has at most 64
  const Record record(from);
  ProcessName process;
  process.host = record.text("host", kLongestText);
  if (std::ranges::any_of(process.host, [](unsigned char c) { return std::iscntrl(c); }))
    refuse_value("host", from.at("host"), "the name of a machine");
  process.boot = record.text("boot", kLongestText);
  process.processes = record.text("processes", kLongestText);
  process.number = static_cast<std::int64_t>(record.whole_number("process", 1, std::numeric_limits<pid_t>::max()));
  process.start = record.whole_number("start", 0, std::numeric_limits<std::uint64_t>::max());
  return process;
}

Running is_running(const ProcessName& process, const ProcessName& seen_from) {
  const bool can_be_seen = !process.boot.empty() && !process.processes.empty() && process.number > 0 &&
                           process.boot == seen_from.boot && process.processes == seen_from.processes;
  if (!can_be_seen) return Running::unknown;
  if (const auto state = state_of(process.number)) {
    const bool same = state->start == process.start && state->letter != 'Z' && state->letter != 'X';
    return same ? Running::yes : Running::no;
  }
  // Systems may hide others' processes from /proc, but not from signals.
  return kill(static_cast<pid_t>(process.number), 0) != 0 && errno == ESRCH ? Running::no : Running::unknown;
}

}  // namespace mars::sinks
