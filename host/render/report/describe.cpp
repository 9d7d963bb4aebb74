#include "host/render/report/describe.h"

#include <fstream>
#include <nlohmann/json.hpp>

#include "hal/failure/failure.h"
#include "hal/failure/plain_text.h"
#include "host/content/document/text.h"
#include "host/render/walls/walls_text.h"

namespace mars::report {
namespace {

using nlohmann::json;

std::string text_of(const json& report) {
  const walls::Explanation walls = walls::explanation_of(report.at("walls"));
  const auto line = [&](const char* key) { return plain_line(report.at(key).get<std::string>()); };
  const auto size = [&](const char* key) { return report.at(key).get_ref<const json::array_t&>().size(); };
  const auto count = [&](const char* key) {
    if (!report.at(key).is_number_unsigned()) throw Failure("is no number", key, "");
    return report.at(key).get<std::uint64_t>();
  };
  std::string text = "report of   " + line("film") + "\n";
  text += "nodes       " + document::counted(size("nodes"), "node") + " in " +
          document::counted(count("groups"), "group") + ", " + line("backend") + "\n";
  text += "frames      " + std::to_string(size("frames")) + "\n";
  text += document::formatted("seconds     %.4g\n", report.at("total_seconds").get<double>());
  return text + "what binds  " + walls::line_of(walls) + "\n" + walls::table_of(walls);
}

Failure damaged(const std::filesystem::path& path) {
  return {"is a report without all that this version writes", path.string(),
          "render again with --report, or read the report with the version that wrote it"};
}

}  // namespace

std::optional<json> read_report(const std::filesystem::path& path) {
  if (!std::filesystem::is_regular_file(path)) return std::nullopt;
  std::ifstream file(path);
  if (file.peek() != '{') return std::nullopt;  // a compiled film, or not there
  json report = json::parse(file, nullptr, false);
  if (!report.is_object() || !report.contains("total_seconds") || !report.contains("frames")) return std::nullopt;
  return report;
}

std::string describe(const json& report, const std::filesystem::path& path) {
  try {
    return text_of(report);
  } catch (const json::exception&) {
    throw damaged(path);
  } catch (const Failure&) {  // names of walls
    throw damaged(path);
  }
}

}  // namespace mars::report
