#include "host/content/importer/gltf/gltf_numbers.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "hal/failure/failure.h"
#include "host/content/document/file.h"
#include "host/content/importer/sources/companion.h"

namespace mars::importer {
namespace {

constexpr std::size_t kHeader = 12, kChunkHeader = 8;
constexpr std::size_t kWholeNumbers = 5125;                // a type of components, of 4 bytes as kFloatType
constexpr std::size_t kMostSparse = std::size_t{1} << 24;  // elements without a view of their own

int base64_digit(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  return c == '+' ? 62 : c == '/' ? 63 : -1;
}

std::string base64_decoded(std::string_view text) {
  std::string bytes;
  unsigned bits = 0;
  int held = 0;
  for (const char c : text) {
    const int digit = base64_digit(c);
    if (digit < 0) break;
    bits = bits << 6 | static_cast<unsigned>(digit);
    held += 6;
    if (held >= 8) bytes += static_cast<char>(bits >> (held -= 8));
  }
  return bytes;
}

// Of a GLB: the chunk after the JSON's.
std::string_view binary_chunk(std::string_view bytes) {
  if (bytes.size() < kHeader + kChunkHeader) return {};
  const std::size_t at = kHeader + kChunkHeader + std::size_t{little_endian_at(bytes, kHeader)};
  if (bytes.size() < at + kChunkHeader) return {};
  return bytes.substr(at + kChunkHeader, little_endian_at(bytes, at));
}

std::size_t width_of(const Tree& type) {
  constexpr std::array<std::pair<std::string_view, std::size_t>, 5> kTypes{
      {{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT4", 16}}};
  for (const auto& [name, width] : kTypes)
    if (type.is_string() && type.get_ref<const std::string&>() == name) return width;
  return 0;
}

std::size_t size_of(std::size_t component) {
  return component == kFloatType                  ? 4
         : component == 5120 || component == 5121 ? 1
         : component == 5122 || component == 5123 ? 2
                                                  : 0;
}

double component_at(std::string_view bytes, std::size_t component, bool normalized) {
  std::uint32_t bits = 0;
  for (std::size_t i = size_of(component); i-- > 0;) bits = bits << 8 | static_cast<unsigned char>(bytes[i]);
  const auto part = [&](double number, double whole) { return normalized ? std::max(number / whole, -1.0) : number; };
  switch (component) {
    case kFloatType: return double(std::bit_cast<float>(bits));
    case 5120: return part(static_cast<std::int8_t>(bits), 127);
    case 5121: return part(bits, 255);
    case 5122: return part(static_cast<std::int16_t>(bits), 32767);
    default: return part(bits, 65535);
  }
}

}  // namespace

GltfBuffers::GltfBuffers(const std::filesystem::path& path, std::string_view bytes, const Tree& gltf, std::string whose)
    : path_(path),
      gltf_(gltf),
      whose_(std::move(whose)),
      own_(is_binary(bytes) ? binary_chunk(bytes) : std::string_view()) {
  for (const Tree& each : at(gltf, "buffers")) {
    const Tree& uri = at(each, "uri");
    std::string content;
    if (uri.is_string()) {
      const std::string& text = uri.get_ref<const std::string&>();
      const std::size_t comma = text.find(',');
      content = text.starts_with("data:")
                    ? base64_decoded(comma == std::string::npos ? "" : std::string_view(text).substr(comma + 1))
                    : document::read_file(companion(path, percent_decoded(text)), kLargestMeshFile);
    }
    buffers_.push_back(std::move(content));
  }
}

std::string_view GltfBuffers::buffer(const Tree& index) const {
  const std::size_t place = number(index, buffers_.size());
  if (place >= buffers_.size()) return {};
  return item(at(gltf_, "buffers"), index).contains("uri") ? std::string_view(buffers_[place]) : own_;
}

// Elements in the bytes of a view; none: they are not all within it.
struct GltfBuffers::Run {
  std::string_view bytes;
  std::size_t first = 0, stride = 0, size = 0;
  bool fits = false;

  std::string_view at(std::size_t element, std::size_t part) const {
    return bytes.substr(first + element * stride + part * size);
  }
};

GltfBuffers::Run GltfBuffers::run(const Tree& part, std::size_t count, std::size_t component, std::size_t width) const {
  const Tree& view = item(at(gltf_, "bufferViews"), at(part, "bufferView"));
  const std::size_t size = size_of(component), element = size * width, stride = number(at(view, "byteStride"), element),
                    first = number(at(part, "byteOffset"), 0), length = number(at(view, "byteLength"), 0),
                    begin = number(at(view, "byteOffset"), 0);
  const std::string_view bytes = view.is_null() ? std::string_view() : buffer(at(view, "buffer"));
  const bool fits = element > 0 && begin <= bytes.size() && length <= bytes.size() - begin && first <= length &&
                    stride >= element && stride <= 252 &&
                    (count == 0 || (element <= length - first && (count - 1) <= (length - first - element) / stride));
  return {bytes, begin + first, stride, size, fits};
}

std::string_view GltfBuffers::bytes_at(const Tree& place) const {
  const std::string_view bytes = buffer(at(place, "buffer"));
  const std::size_t begin = number(at(place, "byteOffset"), 0), length = number(at(place, "byteLength"), 0);
  if (begin > bytes.size() || length > bytes.size() - begin)
    throw Failure("has " + whose_ + " beyond the end of its buffer", path_.string(), "export it again");
  return bytes.substr(begin, length);
}

GltfNumbers GltfBuffers::read_quantized(const Tree& index) const {
  const Tree& normalized = at(item(at(gltf_, "accessors"), index), "normalized");
  return read(index, normalized.is_boolean() && normalized.get<bool>());
}

GltfNumbers GltfBuffers::read(const Tree& index, bool normalized) const {
  const auto refuse = [&](const char* problem) {
    throw Failure("has " + whose_ + " whose accessor " + index.dump() + " " + problem, path_.string(),
                  "export it again");
  };
  const Tree& accessor = item(at(gltf_, "accessors"), index);
  if (accessor.is_null()) refuse("is not there");
  const bool is_sparse = accessor.contains("sparse"), has_view = accessor.contains("bufferView");
  if (!has_view && !is_sparse) refuse("has no numbers");
  const std::size_t component = number(at(accessor, "componentType"), 0), count = number(at(accessor, "count"), 0);
  GltfNumbers read{width_of(at(accessor, "type")), {}};
  if (size_of(component) == 0 || read.width == 0) refuse("has numbers of a kind that is not known");
  if (!has_view && count > kMostSparse) refuse("is sparse, and has too many numbers");
  const Run all = has_view ? run(accessor, count, component, read.width) : Run{};
  if (has_view && !all.fits) refuse("is beyond the end of its buffer");
  if (!has_view) read.numbers.resize(count * read.width);
  for (std::size_t i = 0; has_view && i < count; ++i)
    for (std::size_t j = 0; j < read.width; ++j)
      read.numbers.push_back(component_at(all.at(i, j), component, normalized));
  if (is_sparse) replace_sparse(at(accessor, "sparse"), component, normalized, read);
  if (!std::ranges::all_of(read.numbers, [](double value) { return std::isfinite(value); }))
    refuse("has a number that is none");
  return read;
}

void GltfBuffers::replace_sparse(const Tree& sparse, std::size_t component, bool normalized, GltfNumbers& read) const {
  const Tree& indices = at(sparse, "indices");
  const std::size_t count = number(at(sparse, "count"), 0), type = number(at(indices, "componentType"), 0);
  const Run places = run(indices, count, type == kWholeNumbers ? kFloatType : type, 1),
            values = run(at(sparse, "values"), count, component, read.width);
  bool fits = places.fits && values.fits;
  for (std::size_t i = 0; fits && i < count; ++i) {
    std::size_t place = 0;
    for (std::size_t byte = places.size; byte-- > 0;)
      place = place << 8 | static_cast<unsigned char>(places.at(i, 0)[byte]);
    fits = place < read.count();
    for (std::size_t j = 0; fits && j < read.width; ++j)
      read.numbers[place * read.width + j] = component_at(values.at(i, j), component, normalized);
  }
  if (!fits)
    throw Failure("has " + whose_ + " with a sparse accessor that reaches beyond its numbers", path_.string(),
                  "export it again");
}

}  // namespace mars::importer
