#include "hal/settings.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdlib>
#include <numeric>
#include <string_view>

#include "hal/failure.h"

namespace mars::hal {
namespace {

constexpr std::uint64_t kMiB = 1024 * 1024;

constexpr std::array<Setting, 2> kTable = {{
    {"MARS_MEMORY", "MiB that a node may use for one frame", "a share of the machine's memory"},
    {"MARS_SIMD", "widest instruction set that is used: sse2, sse4, avx2 or avx512",
     "the widest the processor has"},
}};

std::uint64_t parse_memory(const std::string& text) {
  std::uint64_t mebibytes = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, mebibytes);
  if (error != std::errc() || stop != end || mebibytes == 0 || mebibytes > UINT64_MAX / kMiB) {
    throw Failure("\"" + text + "\" is not a number of MiB", "environment variable MARS_MEMORY",
                  "set it to a whole number from 1, or unset it");
  }
  return mebibytes * kMiB;
}

std::string parse_simd(const std::string& text) {
  if (text == "sse2" || text == "sse4" || text == "avx2" || text == "avx512") return text;
  throw Failure("\"" + text + "\" is not an instruction set", "environment variable MARS_SIMD",
                "set it to sse2, sse4, avx2 or avx512, or unset it");
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
  const auto* found = std::min_element(
      kTable.begin(), kTable.end(),
      [name](const Setting& a, const Setting& b) { return edits(name, a.name) < edits(name, b.name); });
  return found->name;
}

}  // namespace

std::span<const Setting> settings_table() { return kTable; }

Settings read_settings() {
  Settings settings;
  if (const char* text = std::getenv("MARS_MEMORY")) settings.memory = parse_memory(text);
  if (const char* text = std::getenv("MARS_SIMD")) settings.simd = parse_simd(text);
  return settings;
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
    if (!name.starts_with("MARS_") || known(name)) continue;
    lines.push_back("environment variable " + name + " means nothing to MARS (did you mean " +
                    std::string(nearest(name)) + "?)");
  }
  return lines;
}

std::string settings_text() {
  std::string text;
  for (const Setting& each : kTable) {
    text += std::string(each.name) + "\n    " + each.meaning + ";\n    without it: " + each.fallback + "\n";
  }
  return text;
}

}  // namespace mars::hal
