#include "host/studio/web/page_files.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <iterator>
#include <optional>
#include <system_error>
#include <utility>

namespace mars::web {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::pair<const char*, const char*>, 8> kTypes{{
    {".html", "text/html; charset=utf-8"},
    {".css", "text/css; charset=utf-8"},
    {".js", "text/javascript; charset=utf-8"},
    {".mjs", "text/javascript; charset=utf-8"},
    {".json", "application/json"},
    {".svg", "image/svg+xml"},
    {".png", "image/png"},
    {".woff2", "font/woff2"},
}};

// Letters, digits, '-', '_', '.' and '/'; no part begins with a dot.
bool is_plain(std::string_view path) {
  const auto good = [](unsigned char c) { return std::isalnum(c) || c == '-' || c == '_' || c == '.' || c == '/'; };
  return path.starts_with('/') && path.find("/.") == path.npos && path.find("//") == path.npos &&
         std::ranges::all_of(path, good);
}

bool is_below(const fs::path& folder, const fs::path& file) {
  return std::mismatch(folder.begin(), folder.end(), file.begin(), file.end()).first == folder.end();
}

std::optional<fs::path> find(const fs::path& folder, std::string_view path) {
  if (!is_plain(path)) return {};
  std::error_code problem;
  const fs::path root = fs::canonical(folder, problem);
  const fs::path file = fs::canonical(root / path.substr(1), problem);
  if (problem || !is_below(root, file) || !fs::is_regular_file(file, problem)) return {};
  return file;
}

}  // namespace

Answer answer_file(const fs::path& folder, std::string_view path, std::string_view known) {
  const auto file = find(folder, path == "/" ? "/index.html" : path);
  const auto type =
      std::ranges::find_if(kTypes, [&](const auto& each) { return file && file->extension() == each.first; });
  if (type == kTypes.end()) return {404, "text/plain; charset=utf-8", "", "There is no such file.\n"};
  std::ifstream stream(*file, std::ios::binary);
  Answer answer{200, type->second, {}, {std::istreambuf_iterator<char>(stream), {}}};
  if (!stream) return {404, "text/plain; charset=utf-8", "", "The file cannot be read.\n"};
  answer.tag = '"' + std::to_string(std::hash<std::string>()(answer.body)) + '"';
  if (answer.tag == known) {
    answer.status = 304;
    answer.body.clear();
  }
  return answer;
}

}  // namespace mars::web
