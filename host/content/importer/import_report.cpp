#include "host/content/importer/import_report.h"

#include <algorithm>

namespace mars::host {
namespace {

constexpr std::size_t kLongestName = 60;

std::string line(std::string_view title, const std::string& text) {
  std::string start = "  " + std::string(title);
  start.resize(13, ' ');
  return start + text + "\n";
}

std::string joined(const std::vector<std::string>& parts) {
  std::string text;
  for (const std::string& part : parts) text += (text.empty() ? "" : ", ") + part;
  return text;
}

}  // namespace

std::string text_of(const ImportReport& report, const std::string& written) {
  std::string text = written + ": " + report.model + "\n" + line("box", report.box) + line("read", joined(report.read));
  if (report.not_read.empty()) return text + line("not read", "nothing: all of the file was read");
  for (std::size_t i = 0; i < report.not_read.size(); ++i) text += line(i == 0 ? "not read" : "", report.not_read[i]);
  return text;
}

std::string counted(std::size_t count, std::string_view one, std::string_view several) {
  return std::to_string(count) + " " + std::string(count == 1 ? one : several);
}

std::string printable(std::string_view text) {
  std::string shown(text.substr(0, kLongestName));
  std::replace_if(
      shown.begin(), shown.end(), [](unsigned char c) { return c < ' ' || c > '~'; }, '?');
  return shown;
}

}  // namespace mars::host
