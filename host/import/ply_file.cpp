#include "host/import/ply_file.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <string_view>

#include "hal/failure.h"
#include "host/document/file.h"
#include "host/import/import_report.h"

namespace mars::host {
namespace {

constexpr std::uintmax_t kLargestFile = std::uintmax_t{1} << 30;

enum class Type { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

struct TypeName {
  std::string_view name;
  Type type;
};

constexpr TypeName kTypeNames[] = {
    {"char", Type::int8},     {"int8", Type::int8},     {"uchar", Type::uint8},     {"uint8", Type::uint8},
    {"short", Type::int16},   {"int16", Type::int16},   {"ushort", Type::uint16},   {"uint16", Type::uint16},
    {"int", Type::int32},     {"int32", Type::int32},   {"uint", Type::uint32},     {"uint32", Type::uint32},
    {"float", Type::float32}, {"float32", Type::float32}, {"double", Type::float64}, {"float64", Type::float64}};

struct Property {
  std::string name;
  Type type;
  std::optional<Type> count;  // of a list: its length's
};

struct PlyElement {
  std::string name;
  std::uint64_t count;
  std::vector<Property> properties;
};

enum class Format { text, little_endian, big_endian };

struct Header {
  Format format = Format::text;
  std::vector<PlyElement> elements;
  std::vector<std::string> textures;
};

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& problem) {
  throw Failure(problem, path.string(), "export it again, or as another of OBJ, STL, glTF, GLB");
}

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
  HeaderReader(const std::filesystem::path& path, std::string_view text) : path_(path), rest_(text) {}

  Header read() {
    if (next_line() != "ply") fail(path_, "does not begin with 'ply'");
    for (;;) {
      const std::string_view line = next_line();
      const std::vector<std::string> words = words_of(line);
      if (words.empty()) continue;
      if (words[0] == "end_header") return finished();
      if (words[0] == "comment" || words[0] == "obj_info")
        add_comment(words);
      else if (!add(words))
        fail(path_, "has a line in its header that is not understood: " + printable(line));
    }
  }

  std::string_view rest() const { return rest_; }

 private:
  // Lines end as the first one does, in "\n" with or without "\r" before it, or in "\r" alone: the bytes after the last
  // line may look like another end.
  std::string_view next_line() {
    if (end_ == 0) end_ = rest_.find('\n') <= rest_.find('\r') || rest_.starts_with("ply\r\n") ? '\n' : '\r';
    const std::size_t at = rest_.find(end_);
    if (at == std::string_view::npos) fail(path_, "ends within its header");
    const std::string_view line = rest_.substr(0, at);
    rest_.remove_prefix(at + 1);
    return line.substr(0, line.find_last_not_of(" \t\r") + 1);
  }

  Header finished() {
    if (!has_format_) fail(path_, "does not say its format");
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
    for (const Property& other : properties)
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
      header_.format = Format::text;
    else if (word == "binary_little_endian")
      header_.format = Format::little_endian;
    else if (word == "binary_big_endian")
      header_.format = Format::big_endian;
    else
      return false;
    return true;
  }

  bool add_element(const std::string& name, const std::string& number) {
    std::uint64_t count = 0;
    const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), count);
    for (const PlyElement& other : header_.elements)
      if (other.name == name) return false;
    header_.elements.push_back({name, count, {}});
    return error == std::errc() && end == number.data() + number.size();
  }

  static std::optional<Type> type_of(const std::string& word) {
    for (const TypeName& known : kTypeNames)
      if (known.name == word) return known.type;
    return std::nullopt;
  }

  const std::filesystem::path& path_;
  std::string_view rest_;
  char end_ = 0;
  bool has_format_ = false;
  Header header_;
};

// The numbers after the header, one after another; none after the last.
class Numbers {
 public:
  Numbers(std::string_view bytes, Format format) : rest_(bytes), format_(format) {}

  std::optional<double> next(Type type) {
    if (format_ == Format::text) return next_word();
    switch (type) {
      case Type::int8: return next_of<std::int8_t>();
      case Type::uint8: return next_of<std::uint8_t>();
      case Type::int16: return next_of<std::int16_t>();
      case Type::uint16: return next_of<std::uint16_t>();
      case Type::int32: return next_of<std::int32_t>();
      case Type::uint32: return next_of<std::uint32_t>();
      case Type::float32: return next_of<float>();
      case Type::float64: return next_of<double>();
    }
    return std::nullopt;
  }

  // White space does not count in a text.
  std::size_t left() {
    if (format_ == Format::text) skip_space();
    return rest_.size();
  }

 private:
  void skip_space() {
    while (!rest_.empty() && std::isspace(static_cast<unsigned char>(rest_.front()))) rest_.remove_prefix(1);
  }

  std::optional<double> next_word() {
    skip_space();
    double value = 0;
    const char* end = rest_.data() + rest_.size();
    const auto [stop, error] = std::from_chars(rest_.data(), end, value);
    if (error != std::errc() || (stop != end && !std::isspace(static_cast<unsigned char>(*stop)))) return std::nullopt;
    rest_.remove_prefix(static_cast<std::size_t>(stop - rest_.data()));
    return value;
  }

  template <typename Number>
  std::optional<double> next_of() {
    std::array<char, sizeof(Number)> bytes;
    if (rest_.size() < bytes.size()) return std::nullopt;
    std::copy_n(rest_.begin(), bytes.size(), bytes.begin());
    rest_.remove_prefix(bytes.size());
    const bool little = format_ == Format::little_endian;
    if (little != (std::endian::native == std::endian::little)) std::reverse(bytes.begin(), bytes.end());
    return std::bit_cast<Number>(bytes);
  }

  std::string_view rest_;
  Format format_;
};

// Reads the elements in the header's order.
class BodyReader {
 public:
  BodyReader(const std::filesystem::path& path, const Header& header, std::string_view body)
      : path_(path), header_(header), numbers_(body, header.format) {}

  PlyFile read() {
    for (const std::string& texture : header_.textures) file_.not_read.push_back("texture " + printable(texture));
    for (const PlyElement& element : header_.elements) read_element(element);
    const std::size_t left = numbers_.left();
    if (left > 0 && header_.format == Format::text) fail(path_, "goes on after all that its header promises");
    if (left > 0) file_.not_read.push_back(counted(left, "byte", "bytes") + " after all that the header promises");
    check_corners();
    return std::move(file_);
  }

 private:
  void read_element(const PlyElement& element) {
    if (element.properties.empty()) return;  // rows of no bytes
    const auto names = wanted(element);
    note_others(element, names);
    std::vector<std::size_t> places;  // of each property in names; names.size() for the others
    for (const Property& property : element.properties)
      places.push_back(static_cast<std::size_t>(std::find(names.begin(), names.end(), property.name) - names.begin()));
    std::vector<double> row(names.size()), list;
    for (std::uint64_t i = 0; i < element.count; ++i) {
      for (std::size_t p = 0; p < places.size(); ++p) {
        if (!read_property(element.properties[p], list)) fail_short(element, i);
        if (places[p] == names.size()) continue;
        if (element.name != "vertex")
          add_corners(element.name, list);
        else
          row[places[p]] = list.at(0);
      }
      if (element.name == "vertex") add_vertex(row);
    }
  }

  static bool has(const PlyElement& element, std::string_view name, bool list) {
    return std::any_of(element.properties.begin(), element.properties.end(), [&](const Property& property) {
      return property.name == name && property.count.has_value() == list;
    });
  }

  // The names of the element's properties that are read.
  std::vector<std::string_view> wanted(const PlyElement& element) const {
    if (element.name == "vertex") {
      for (const char* axis : {"x", "y", "z"})
        if (!has(element, axis, false)) fail(path_, std::string("gives its vertices no ") + axis);
      if (has(element, "nx", false) && has(element, "ny", false) && has(element, "nz", false))
        return {"x", "y", "z", "nx", "ny", "nz"};
      return {"x", "y", "z"};
    }
    if (element.name == "face" || element.name == "tristrips")
      for (const char* name : {"vertex_indices", "vertex_index"})
        if (has(element, name, true)) return {name};
    return {};
  }

  void note_others(const PlyElement& element, const std::vector<std::string_view>& names) {
    const std::string name = printable(element.name);
    if (element.count == 0) return;
    if (names.empty()) {
      file_.not_read.push_back(counted(element.count, "row", "rows") + " of element '" + name + "'");
      return;
    }
    std::string others;
    for (const Property& property : element.properties)
      if (std::find(names.begin(), names.end(), property.name) == names.end())
        others += (others.empty() ? "" : ", ") + printable(property.name);
    if (!others.empty()) file_.not_read.push_back("of element '" + name + "': " + others);
  }

  // Into `list`; a single number is a list of one. False at the end of the file.
  bool read_property(const Property& property, std::vector<double>& list) {
    list.clear();
    double count = 1;
    if (property.count) {
      const auto length = numbers_.next(*property.count);
      if (!length || !(*length >= 0) || *length != std::floor(*length)) return false;
      count = *length;
    }
    for (double i = 0; i < count; ++i) {
      const auto number = numbers_.next(property.type);
      if (!number) return false;
      list.push_back(*number);
    }
    return true;
  }

  [[noreturn]] void fail_short(const PlyElement& element, std::uint64_t rows) {
    const std::string row = "row of element '" + printable(element.name) + "'", rows_of = "rows" + row.substr(3);
    const bool vertices = element.name == "vertex", faces = element.name == "face";
    fail(path_, "promises " + counted(element.count, vertices ? "vertex" : faces ? "face" : row,
                                      vertices ? "vertices" : faces ? "faces" : rows_of) +
                    ", " + counted(rows, "was read", "were read"));
  }

  void add_vertex(const std::vector<double>& row) {
    file_.places.emplace_back(row[0], row[1], row[2]);
    if (row.size() == 6) file_.normals.emplace_back(row[3], row[4], row[5]);
  }

  void add_corners(const std::string& element, const std::vector<double>& list) {
    if (element == "tristrips") return add_strips(list);
    for (const double number : list) file_.corners.push_back(corner_of(number));
    file_.ends.push_back(file_.corners.size());
  }

  // Each number makes a triangle with the two before it, every second one the other way round; -1 begins a new strip.
  // Two equal numbers only lead the strip elsewhere.
  void add_strips(const std::vector<double>& list) {
    std::array<std::uint32_t, 2> last{};
    std::size_t length = 0;
    for (const double number : list) {
      if (number == -1) {
        length = 0;
        continue;
      }
      const std::uint32_t corner = corner_of(number);
      if (length >= 2 && last[0] != last[1] && last[1] != corner && corner != last[0]) {
        const bool even = length % 2 == 0;
        file_.corners.insert(file_.corners.end(), {last[even ? 0 : 1], last[even ? 1 : 0], corner});
        file_.ends.push_back(file_.corners.size());
      }
      last = {last[1], corner};
      ++length;
    }
  }

  std::uint32_t corner_of(double number) const {
    if (!(number >= 0 && number < std::numeric_limits<std::uint32_t>::max()) || number != std::floor(number))
      fail(path_, "has a face with a corner that is no vertex's number");
    return static_cast<std::uint32_t>(number);
  }

  // Faces may stand before the vertices, so their numbers are checked at the end.
  void check_corners() {
    std::vector<bool> used(file_.places.size());
    for (const std::uint32_t corner : file_.corners) {
      if (corner >= used.size())
        fail(path_, "has a face with a corner at vertex " + std::to_string(corner) + ", of " +
                        std::to_string(used.size()) + " from 0");
      used[corner] = true;
    }
    const auto lonely = static_cast<std::size_t>(std::count(used.begin(), used.end(), false));
    if (lonely > 0 && !file_.corners.empty())
      file_.not_read.push_back(counted(lonely, "vertex", "vertices") + " without a face");
  }

  const std::filesystem::path& path_;
  const Header& header_;
  Numbers numbers_;
  PlyFile file_;
};

}  // namespace

PlyFile read_ply_file(const std::filesystem::path& path) {
  const std::string text = read_file(path, kLargestFile);
  HeaderReader reader(path, text);
  const Header header = reader.read();
  return BodyReader(path, header, reader.rest()).read();
}

}  // namespace mars::host
