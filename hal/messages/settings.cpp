#include "hal/messages/settings.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <cstdlib>
#include <numeric>
#include <string_view>
#include <system_error>

#include "hal/failure/failure.h"

namespace mars::messages {
namespace {

constexpr std::uint64_t kMiB = 1024 * 1024;

constexpr std::array<Setting, 7> kTable = {{
    {"MARS_MEMORY", "MiB that a node may use for frames",
     "its equal share of half of the machine's memory, at most 4096"},
    {"MARS_NX_HANDLERS", "thread: handlers of NX programs run on a thread of their own; or calls",
     "they run inside of NX calls"},
    {"MARS_NX_COLLECTIVES", "cube, mpi or auto: global operations by NX messages or MPI's own",
     "auto, which takes the cube"},
    {"MARS_NX_HOST", "yes or no: rank 0 of an MPI job of NX programs is the host",
     "it is where its program is another than the others'"},
    {"MARS_NX_MEMORY", "MiB that messages under way between processes of mars-nx may take",
     "half of the machine's memory"},
    {"MARS_NX_STRICT", "yes or no: NX buffers no messages over 100 bytes and reports long waits",
     "all messages are buffered"},
    {"MARS_SIMD", "widest instruction set that is used: sse2, sse4, avx2 or avx512", "the widest the processor has"},
}};

std::uint64_t parse_memory(const std::string& name, const std::string& text) {
  std::uint64_t mebibytes = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, mebibytes);
  if (error != std::errc() || stop != end || mebibytes == 0 || mebibytes > UINT64_MAX / kMiB) {
    throw Failure("\"" + text + "\" is not a number of MiB", "environment variable " + name,
                  "set it to a whole number from 1, or unset it");
  }
  return mebibytes * kMiB;
}

bool parse_yes(const std::string& name, const std::string& text) {
  if (text == "yes" || text == "no") return text == "yes";
  throw Failure("\"" + text + "\" is neither yes nor no", "environment variable " + name,
                "set it to yes or no, or unset it");
}

bool parse_handlers(const std::string& text) {
  if (text == "thread" || text == "calls") return text == "thread";
  throw Failure("\"" + text + "\" is neither thread nor calls", "environment variable MARS_NX_HANDLERS",
                "set it to thread or calls, or unset it");
}

std::string parse_simd(const std::string& text) {
  if (text == "sse2" || text == "sse4" || text == "avx2" || text == "avx512") return text;
  throw Failure("\"" + text + "\" is not an instruction set", "environment variable MARS_SIMD",
                "set it to sse2, sse4, avx2 or avx512, or unset it");
}

CollectiveMethod parse_collectives(const std::string& text) {
  if (text == "cube") return CollectiveMethod::cube;
  if (text == "mpi") return CollectiveMethod::network;
  if (text == "auto") return CollectiveMethod::automatic;
  throw Failure("\"" + text + "\" is no way of global operations", "environment variable MARS_NX_COLLECTIVES",
                "set it to cube, mpi or auto, or unset it");
}

// Letters to insert, delete or change to get from one to the other.
int edits(std::string_view a, std::string_view b) {
  std::vector<int> row(b.size() + 1);
  std::iota(row.begin(), row.end(), 0);
  for (std::size_t i = 0; i < a.size(); ++i) {
    int diagonal = row[0]++;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const int changed = diagonal + (a[i] != b[j]);
      diagonal = row[j + 1];
      row[j + 1] = std::min({changed, diagonal + 1, row[j] + 1});
    }
  }
  return row.back();
}

bool known(std::string_view name) {
  return std::any_of(kTable.begin(), kTable.end(), [name](const Setting& each) { return name == each.name; });
}

std::string_view nearest(std::string_view name) {
  const auto* found = std::min_element(kTable.begin(), kTable.end(), [name](const Setting& a, const Setting& b) {
    return edits(name, a.name) < edits(name, b.name);
  });
  return found->name;
}

}  // namespace

std::span<const Setting> settings_table() { return kTable; }

Settings read_settings() {
  Settings settings;
  if (const char* text = std::getenv("MARS_MEMORY")) settings.memory = parse_memory("MARS_MEMORY", text);
  if (const char* text = std::getenv("MARS_NX_MEMORY")) settings.nx_memory = parse_memory("MARS_NX_MEMORY", text);
  if (const char* text = std::getenv("MARS_NX_COLLECTIVES")) settings.nx_collectives = parse_collectives(text);
  if (const char* text = std::getenv("MARS_NX_HOST")) settings.nx_host = parse_yes("MARS_NX_HOST", text);
  if (const char* text = std::getenv("MARS_NX_STRICT")) settings.nx_strict = parse_yes("MARS_NX_STRICT", text);
  if (const char* text = std::getenv("MARS_NX_HANDLERS")) settings.nx_handler_thread = parse_handlers(text);
  if (const char* text = std::getenv("MARS_SIMD")) settings.simd = parse_simd(text);
  return settings;
}

// By Open MPI, or by a launcher that speaks PMIx (srun too), PMI-1 or PMI-2 (MPICH's).
bool started_by_mpi() {
  const std::array names = {"OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_RANK", "PMI_FD"};
  return std::any_of(names.begin(), names.end(), [](const char* name) { return std::getenv(name) != nullptr; });
}

std::optional<std::string> take_place_text() {
  const char* text = std::getenv(kPlaceSetting);
  if (text == nullptr) return std::nullopt;
  std::string place = text;
  unsetenv(kPlaceSetting);
  return place;
}

TerminalKind terminal_kind() {
  const char* name = std::getenv("TERM");
  const char* colors = std::getenv("COLORTERM");
  const std::string_view words = colors == nullptr ? "" : colors;
  return {name == nullptr ? "" : name, words == "truecolor" || words == "24bit"};
}

std::vector<std::string> unknown_settings() {
  std::vector<std::string> lines;
  for (char** variable = environ; variable != nullptr && *variable != nullptr; ++variable) {
    const std::string_view line = *variable;
    const std::string name(line.substr(0, line.find('=')));
    if (!name.starts_with("MARS_") || known(name) || name == kPlaceSetting) continue;
    lines.push_back("environment variable " + name + " means nothing to MARS (did you mean " +
                    std::string(nearest(name)) + "?)");
  }
  return lines;
}

std::string settings_text(bool of_nx) {
  std::string text;
  for (const Setting& each : kTable) {
    if (each.of_nx() != of_nx) continue;
    text += std::string(each.name) + "\n    " + each.meaning + ";\n    without it: " + each.fallback + "\n";
  }
  return text;
}

}  // namespace mars::messages
