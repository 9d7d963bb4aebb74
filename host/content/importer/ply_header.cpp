#include "host/content/importer/ply_header.h"

#include <algorithm>
#include <charconv>

#include "hal/failure/failure.h"
#include "host/content/document/text.h"

namespace mars::importer {
namespace {

struct TypeName {
  std::string_view name;
  PlyType type;
};

constexpr TypeName kTypeNames[] = {
    {"char", PlyType::int8},      {"int8", PlyType::int8},       {"uchar", PlyType::uint8},
    {"uint8", PlyType::uint8},    {"short", PlyType::int16},     {"int16", PlyType::int16},
    {"ushort", PlyType::uint16},  {"uint16", PlyType::uint16},   {"int", PlyType::int32},
    {"int32", PlyType::int32},    {"uint", PlyType::uint32},     {"uint32", PlyType::uint32},
    {"float", PlyType::float32},  {"float32", PlyType::float32}, {"double", PlyType::float64},
    {"float64", PlyType::float64}};

std::vector<std::string> words_of(std::string_view line) {
  std::vector<std::string> words;
  for (std::size_t at = 0; (at = line.find_first_not_of(" \t", at)) < line.size();) {
    const std::size_t end = std::min(line.find_first_of(" \t", at), line.size());
    words.emplace_back(line.substr(at, end - at));
    at = end;
  }
  return words;
}

class HeaderReader {
 public:
  HeaderReader(const std::filesystem::path& path, std::string_view text)
      : path_(path), rest_(text), size_(text.size()) {}

  PlyHeader read() {
    if (next_line() != "ply") fail_ply(path_, "does not begin with 'ply'");
    for (;;) {
      const std::string_view line = next_line();
      const std::vector<std::string> words = words_of(line);
      if (words.empty()) continue;
      if (words[0] == "end_header") return finished();
      if (words[0] == "comment" || words[0] == "obj_info")
        add_comment(words);
      else if (!add(words))
        fail_ply(path_, "has a line in its header that is not understood: " + document::printable(line));
    }
  }

 private:
  // Lines end as the first one does, in "\n" with or without "\r" before it, or in "\r" alone: the bytes after the last
  // line may look like another end.
  std::string_view next_line() {
    if (end_ == 0) end_ = rest_.find('\n') <= rest_.find('\r') || rest_.starts_with("ply\r\n") ? '\n' : '\r';
    const std::size_t at = rest_.find(end_);
    if (at == std::string_view::npos) fail_ply(path_, "ends within its header");
    const std::string_view line = rest_.substr(0, at);
    rest_.remove_prefix(at + 1);
    return line.substr(0, line.find_last_not_of(" \t\r") + 1);
  }

  PlyHeader finished() {
    if (!has_format_) fail_ply(path_, "does not say its format");
    header_.bytes = size_ - rest_.size();
    return std::move(header_);
  }

  void add_comment(const std::vector<std::string>& words) {
    if (words.size() > 2 && words[1] == "TextureFile") header_.textures.push_back(words[2]);
  }

  bool add(const std::vector<std::string>& words) {
    if (words[0] == "format" && words.size() == 3) return set_format(words[1]);
    if (words[0] == "element" && words.size() == 3) return add_element(words[1], words[2]);
    if (words[0] != "property" || header_.elements.empty()) return false;
    auto& properties = header_.elements.back().properties;
    for (const PlyProperty& other : properties)
      if (other.name == words.back()) return false;
    if (words.size() == 3) {
      const auto type = type_of(words[1]);
      if (type) properties.push_back({words[2], *type, {}});
      return type.has_value();
    }
    if (words.size() != 5 || words[1] != "list") return false;
    const auto count = type_of(words[2]), type = type_of(words[3]);
    if (count && type) properties.push_back({words[4], *type, count});
    return count && type;
  }

  bool set_format(const std::string& word) {
    has_format_ = true;
    if (word == "ascii")
      header_.format = PlyFormat::text;
    else if (word == "binary_little_endian")
      header_.format = PlyFormat::little_endian;
    else if (word == "binary_big_endian")
      header_.format = PlyFormat::big_endian;
    else
      return false;
    return true;
  }

  bool add_element(const std::string& name, const std::string& number) {
    const auto count = document::number_in<std::uint64_t>(number);
    for (const PlyElement& other : header_.elements)
      if (other.name == name) return false;
    header_.elements.push_back({name, count.value_or(0), {}});
    return count.has_value();
  }

  static std::optional<PlyType> type_of(const std::string& word) {
    for (const TypeName& known : kTypeNames)
      if (known.name == word) return known.type;
    return std::nullopt;
  }

  const std::filesystem::path& path_;
  std::string_view rest_;
  std::size_t size_;
  char end_ = 0;
  bool has_format_ = false;
  PlyHeader header_;
};

}  // namespace

PlyHeader read_ply_header(const std::filesystem::path& path, std::string_view text) {
  return HeaderReader(path, text).read();
}

void fail_ply(const std::filesystem::path& path, const std::string& problem) {
  throw Failure(problem, path.string(), "export it again, or as another of OBJ, STL, glTF, GLB");
}

}  // namespace mars::importer
