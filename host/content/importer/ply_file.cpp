#include "host/content/importer/ply_file.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <string_view>

#include "host/content/document/file.h"
#include "host/content/document/text.h"
#include "host/content/importer/paint.h"
#include "host/content/importer/ply_header.h"

namespace mars::importer {
namespace {

constexpr std::uintmax_t kLargestFile = std::uintmax_t{1} << 30;

// The numbers after the header, one after another; none after the last.
class Numbers {
 public:
  Numbers(std::string_view bytes, PlyFormat format) : rest_(bytes), format_(format) {}

  std::optional<double> next(PlyType type) {
    if (format_ == PlyFormat::text) return next_word();
    switch (type) {
      case PlyType::int8: return next_of<std::int8_t>();
      case PlyType::uint8: return next_of<std::uint8_t>();
      case PlyType::int16: return next_of<std::int16_t>();
      case PlyType::uint16: return next_of<std::uint16_t>();
      case PlyType::int32: return next_of<std::int32_t>();
      case PlyType::uint32: return next_of<std::uint32_t>();
      case PlyType::float32: return next_of<float>();
      case PlyType::float64: return next_of<double>();
    }
    return std::nullopt;
  }

  // White space does not count in a text.
  std::size_t left() {
    if (format_ == PlyFormat::text) skip_space();
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
    const bool little = format_ == PlyFormat::little_endian;
    if (little != (std::endian::native == std::endian::little)) std::reverse(bytes.begin(), bytes.end());
    return std::bit_cast<Number>(bytes);
  }

  std::string_view rest_;
  PlyFormat format_;
};

constexpr std::array<std::string_view, 3> kNormal{"nx", "ny", "nz"};
constexpr std::array<std::string_view, 4> kColor{"red", "green", "blue", "alpha"};
constexpr std::array<std::array<std::string_view, 2>, 3> kUv{{{"u", "v"}, {"s", "t"}, {"texture_u", "texture_v"}}};

// What a vertex has besides its place, in the order in which it is read.
struct VertexLayout {
  std::span<const std::string_view> normal{}, uv{}, color{};  // names; none: it has none
  double whole = 1;                                           // a full part of a colour
};

// The number that stands for all of a colour's part; 0: none does.
double whole_of(PlyType type) {
  return type == PlyType::uint8                                 ? 255
         : type == PlyType::uint16                              ? 65535
         : type == PlyType::float32 || type == PlyType::float64 ? 1
                                                                : 0;
}

std::vector<std::string_view> names_of(const VertexLayout& layout) {
  std::vector<std::string_view> names{"x", "y", "z"};
  for (const auto& more : {layout.normal, layout.uv, layout.color}) names.insert(names.end(), more.begin(), more.end());
  return names;
}

// Reads the elements in the header's order.
class BodyReader {
 public:
  BodyReader(const std::filesystem::path& path, const PlyHeader& header, std::string_view body)
      : path_(path), header_(header), numbers_(body, header.format) {}

  PlyFile read() {
    for (const std::string& texture : header_.textures)
      file_.not_read.push_back("texture " + document::printable(texture));
    for (const PlyElement& element : header_.elements) read_element(element);
    const std::size_t left = numbers_.left();
    if (left > 0 && header_.format == PlyFormat::text) fail_ply(path_, "goes on after all that its header promises");
    if (left > 0)
      file_.not_read.push_back(document::counted(left, "byte", "bytes") + " after all that the header promises");
    check_corners();
    return std::move(file_);
  }

 private:
  void read_element(const PlyElement& element) {
    if (element.properties.empty()) return;  // rows of no bytes
    const auto names = wanted(element);
    note_others(element, names);
    std::vector<std::size_t> places;  // of each property in names; names.size() for the others
    for (const PlyProperty& property : element.properties)
      places.push_back(static_cast<std::size_t>(std::find(names.begin(), names.end(), property.name) - names.begin()));
    std::vector<double> row(names.size()), list;
    const VertexLayout layout = element.name == "vertex" ? layout_of(element) : VertexLayout{};
    for (std::uint64_t i = 0; i < element.count; ++i) {
      for (std::size_t p = 0; p < places.size(); ++p) {
        if (!read_property(element.properties[p], list)) fail_short(element, i);
        if (places[p] == names.size()) continue;
        if (element.name != "vertex")
          add_corners(element.name, list);
        else
          row[places[p]] = list.at(0);
      }
      if (element.name == "vertex") add_vertex(row, layout);
    }
  }

  static bool has(const PlyElement& element, std::string_view name, bool list) {
    return std::any_of(element.properties.begin(), element.properties.end(), [&](const PlyProperty& property) {
      return property.name == name && property.count.has_value() == list;
    });
  }

  static bool has_all(const PlyElement& element, std::span<const std::string_view> names) {
    return std::ranges::all_of(names, [&](std::string_view name) { return has(element, name, false); });
  }

  static VertexLayout layout_of(const PlyElement& vertex) {
    VertexLayout layout;
    if (has_all(vertex, kNormal)) layout.normal = kNormal;
    const auto red = std::ranges::find(vertex.properties, kColor[0], &PlyProperty::name);
    if (has_all(vertex, std::span(kColor).first(3)) && whole_of(red->type) > 0) {
      layout.color = std::span(kColor).first(has(vertex, kColor[3], false) ? 4 : 3);
      layout.whole = whole_of(red->type);
    }
    for (const auto& pair : kUv)
      if (layout.uv.empty() && has_all(vertex, pair)) layout.uv = pair;
    return layout;
  }

  // The names of the element's properties that are read.
  std::vector<std::string_view> wanted(const PlyElement& element) const {
    if (element.name == "vertex") {
      for (const char* axis : {"x", "y", "z"})
        if (!has(element, axis, false)) fail_ply(path_, std::string("gives its vertices no ") + axis);
      return names_of(layout_of(element));
    }
    if (element.name == "face" || element.name == "tristrips")
      for (const char* name : {"vertex_indices", "vertex_index"})
        if (has(element, name, true)) return {name};
    return {};
  }

  void note_others(const PlyElement& element, const std::vector<std::string_view>& names) {
    const std::string name = document::printable(element.name);
    if (element.count == 0) return;
    if (names.empty()) {
      file_.not_read.push_back(document::counted(element.count, "row", "rows") + " of element '" + name + "'");
      return;
    }
    std::string others;
    for (const PlyProperty& property : element.properties)
      if (std::find(names.begin(), names.end(), property.name) == names.end())
        others += (others.empty() ? "" : ", ") + document::printable(property.name);
    if (!others.empty()) file_.not_read.push_back("of element '" + name + "': " + others);
  }

  // Into `list`; a single number is a list of one. False at the end of the file.
  bool read_property(const PlyProperty& property, std::vector<double>& list) {
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
    const std::string row = "row of element '" + document::printable(element.name) + "'",
                      rows_of = "rows" + row.substr(3);
    const bool vertices = element.name == "vertex", faces = element.name == "face";
    fail_ply(path_, "promises " +
                        document::counted(element.count,
                                          vertices ? "vertex"
                                          : faces  ? "face"
                                                   : row,
                                          vertices ? "vertices"
                                          : faces  ? "faces"
                                                   : rows_of) +
                        ", " + document::counted(rows, "was read", "were read"));
  }

  void add_vertex(const std::vector<double>& row, const VertexLayout& layout) {
    const double* next = row.data();
    file_.places.emplace_back(next[0], next[1], next[2]);
    next += 3;
    if (!layout.normal.empty()) file_.normals.emplace_back(next[0], next[1], next[2]);
    next += layout.normal.size();
    if (!layout.uv.empty()) file_.uv.push_back(place_in_image(next[0], next[1]));
    next += layout.uv.size();
    if (layout.color.empty()) return;
    std::array<float, 4> color{1, 1, 1, 1};
    for (std::size_t i = 0; i < layout.color.size(); ++i) color[i] = shown_part(next[i] / layout.whole, false);
    file_.colors.push_back(color);
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
      fail_ply(path_, "has a face with a corner that is no vertex's number");
    return static_cast<std::uint32_t>(number);
  }

  // Faces may stand before the vertices, so their numbers are checked at the end.
  void check_corners() {
    std::vector<bool> used(file_.places.size());
    for (const std::uint32_t corner : file_.corners) {
      if (corner >= used.size())
        fail_ply(path_, "has a face with a corner at vertex " + std::to_string(corner) + ", of " +
                            std::to_string(used.size()) + " from 0");
      used[corner] = true;
    }
    const auto lonely = static_cast<std::size_t>(std::count(used.begin(), used.end(), false));
    if (lonely > 0 && !file_.corners.empty())
      file_.not_read.push_back(document::counted(lonely, "vertex", "vertices") + " without a face");
  }

  const std::filesystem::path& path_;
  const PlyHeader& header_;
  Numbers numbers_;
  PlyFile file_;
};

}  // namespace

PlyFile read_ply_file(const std::filesystem::path& path) {
  const std::string text = document::read_file(path, kLargestFile);
  const PlyHeader header = read_ply_header(path, text);
  return BodyReader(path, header, std::string_view(text).substr(header.bytes)).read();
}

}  // namespace mars::importer
