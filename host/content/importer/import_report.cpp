#include "host/content/importer/import_report.h"

#include "host/content/document/text.h"

namespace mars::importer {
namespace {

std::string line(std::string_view title, const std::string& text) {
  std::string start = "  " + std::string(title);
  start.resize(13, ' ');
  return start + text + "\n";
}

}  // namespace

std::string text_of(const ImportReport& report, const std::string& written) {
  std::string text =
      written + ": " + report.model + "\n" + line("box", report.box) + line("read", document::joined(report.read));
  if (report.not_read.empty()) return text + line("not read", "nothing: all of the file was read");
  for (std::size_t i = 0; i < report.not_read.size(); ++i) text += line(i == 0 ? "not read" : "", report.not_read[i]);
  return text;
}

}  // namespace mars::importer
