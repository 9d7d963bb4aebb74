#include "host/content/importer/import_report.h"

#include "host/content/document/text.h"

namespace mars::importer {
namespace {

std::string line(std::string_view title, const std::string& text) {
  std::string start = "  " + std::string(title);
  start.resize(13, ' ');
  return start + text + "\n";
}

std::string list(std::string_view title, const std::vector<std::string>& items) {
  std::string text;
  for (const std::string& item : items) text += line(text.empty() ? title : "", item);
  return text;
}

}  // namespace

std::string text_of(const ImportReport& report, const std::string& written) {
  std::string text =
      written + ": " + report.model + "\n" + line("box", report.box) + line("read", document::joined(report.read));
  text += list("made", report.made);
  if (!report.kept.empty()) text += line("kept", document::joined(report.kept) + " (no picture shows them yet)");
  return text + (report.not_read.empty() ? line("not read", "nothing: all of the file was read")
                                         : list("not read", report.not_read));
}

}  // namespace mars::importer
