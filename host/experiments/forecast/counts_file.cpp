#include "host/experiments/forecast/counts_file.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

#include "hal/failure/failure.h"
#include "host/content/document/checksum.h"
#include "host/content/document/file.h"
#include "host/content/document/whole_file.h"
#include "host/images/picture_bands.h"
#include "node/wire/pixel_version.h"

namespace mars::forecast {
namespace {

constexpr std::uint32_t kVersion = 2;  // of files of counts, and of what is counted
// As .mars files: no text file begins so, and a transfer as text breaks it.
constexpr std::array<char, 8> kMagic = {'\x89', 'M', 'C', 'N', 'T', '\r', '\n', '\x1a'};

using Digits = std::array<char, 32>;

struct Header {
  std::array<char, 8> magic;
  std::uint32_t version;
  std::uint32_t byte_order;
  std::uint64_t bytes;  // that follow
  Digits content;
  Digits checksum;  // of all before it and behind it
};
static_assert(sizeof(Header) == 88);

constexpr std::uint32_t kByteOrder = 0x01020304;

Digits digits(const std::string& text) {
  check(text.size() == std::tuple_size_v<Digits>, "a checksum has 32 digits");
  Digits copy;
  std::ranges::copy(text, copy.begin());
  return copy;
}

Digits checksum_over(const Header& header, std::string_view body) {
  document::Checksum checksum;
  checksum.add(std::as_bytes(std::span(&header, 1)).first(offsetof(Header, checksum)));
  checksum.add(std::as_bytes(std::span(body)));
  return digits(checksum.digits());
}

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& what) {
  throw Failure(what, path.string(), "remove it, so that the film is counted again, or name another file");
}

constexpr double kMostReal = 1e12;  // of any frame

// Numbers of seven bits a byte, the low ones first; 128 in a byte says that more follow.
class Writer {
 public:
  explicit Writer(std::string& to) : to_(to) {}

  template <typename Whole>
  void whole(const Whole& number) {
    std::uint64_t left = static_cast<std::uint64_t>(number);
    for (; left >= 128; left >>= 7) to_.push_back(static_cast<char>(left | 128));
    to_.push_back(static_cast<char>(left));
  }
  // Few are no whole numbers.
  void real(const double& number) {
    constexpr double kMost = 1ull << 52;
    if (number >= 0 && number < kMost && std::trunc(number) == number)
      return whole(static_cast<std::uint64_t>(number) << 1);
    whole(1u);
    const auto bits = std::bit_cast<std::array<char, sizeof number>>(number);
    to_.append(bits.data(), bits.size());
  }
  template <typename Item, typename Pass>
  void items(const std::vector<Item>& all, const Pass& pass) {
    whole(all.size());
    for (const Item& item : all) pass(*this, item);
  }

 private:
  std::string& to_;
};

class Reader {
 public:
  Reader(std::string_view from, const std::filesystem::path& path) : left_(from), path_(path) {}

  template <typename Whole>
  void whole(Whole& number) {
    std::uint64_t all = 0;
    for (int shift = 0;; shift += 7) {
      const auto byte = static_cast<unsigned char>(take(1).front());
      all |= static_cast<std::uint64_t>(byte & 127) << shift;
      if (byte < 128) break;
      if (shift > 56) refuse_numbers();
    }
    number = static_cast<Whole>(all);
  }
  void real(double& number) {
    std::uint64_t twice = 0;
    whole(twice);
    number = static_cast<double>(twice >> 1);
    if (twice == 1) {
      std::array<char, sizeof number> bits;
      std::ranges::copy(take(bits.size()), bits.begin());
      number = std::bit_cast<double>(bits);
    }
    if (!(number >= 0 && number <= kMostReal)) refuse_numbers();
  }
  // Each takes a byte at least.
  template <typename Item, typename Pass>
  void items(std::vector<Item>& all, const Pass& pass) {
    std::size_t count = 0;
    whole(count);
    if (count > left_.size()) refuse_numbers();
    all.resize(count);
    for (Item& item : all) pass(*this, item);
  }
  bool is_at_end() const { return left_.empty(); }
  [[noreturn]] void refuse_numbers() const { refuse(path_, "has counts that make no sense"); }

 private:
  std::string_view take(std::size_t bytes) {
    if (left_.size() < bytes) refuse_numbers();
    const std::string_view taken = left_.substr(0, bytes);
    left_.remove_prefix(bytes);
    return taken;
  }

  std::string_view left_;
  const std::filesystem::path& path_;
};

// The same functions write and read: `Of` is const where they write.

template <typename Archive, typename Of>
void pass_units(Archive& archive, Of& units) {
  for (auto& number : units.units) archive.real(number);
}

template <typename Archive, typename Of>
void pass_seen(Archive& archive, Of& seen) {
  for (auto* number : {&seen.pixels, &seen.runs, &seen.shaded, &seen.highlights, &seen.facets, &seen.block_pixels,
                       &seen.points, &seen.kept_groups})
    archive.real(*number);
}

template <typename Archive, typename Of>
void pass_line(Archive& archive, Of& line) {
  for (auto* number : {&line.edge_boxes, &line.samples, &line.moving_edge_boxes, &line.moving_samples,
                       &line.moving_width, &line.kept_width, &line.swept_width})
    archive.real(*number);
  pass_seen(archive, line.constant);
  pass_seen(archive, line.moving);
}

template <typename Archive, typename Of>
void pass_caster(Archive& archive, Of& caster) {
  for (auto* line : {&caster.first_line, &caster.last_line, &caster.first_put, &caster.last_put}) archive.whole(*line);
  archive.whole(caster.diced_by);
  for (auto* number : {&caster.vertices, &caster.put_vertices, &caster.triangles}) archive.real(*number);
}

template <typename Archive, typename Of>
void pass_blocks(Archive& archive, Of& blocks) {
  archive.items(blocks, [](auto& to, auto& stretch) {
    for (auto* number : {&stretch.row, &stretch.first, &stretch.last, &stretch.filled}) to.whole(*number);
  });
}

template <typename Archive, typename Of>
void pass_totals(Archive& archive, Of& totals) {
  pass_units(archive, totals.made);
  pass_line(archive, totals.drawn);
  for (auto* number : {&totals.lines, &totals.changed, &totals.kept_points}) archive.real(*number);
  pass_units(archive, totals.casters);
  pass_blocks(archive, totals.blocks);
}

template <typename Archive, typename Of>
void pass_keyframe(Archive& archive, Of& keyframe) {
  archive.whole(keyframe.frame);
  pass_units(archive, keyframe.made);
  archive.items(keyframe.lines, [](auto& to, auto& line) { pass_line(to, line); });
  pass_blocks(archive, keyframe.constant_blocks);
  pass_blocks(archive, keyframe.moving_blocks);
  archive.whole(keyframe.first_still_line);
  archive.whole(keyframe.last_still_line);
  archive.items(keyframe.casters, [](auto& to, auto& caster) { pass_caster(to, caster); });
  archive.real(keyframe.kept_points);
  archive.items(keyframe.placed, [](auto& to, auto& placed) { to.whole(placed.number), to.whole(placed.surface); });
}

template <typename Archive, typename Of>
void pass_task(Archive& archive, Of& task) {
  archive.whole(task.keyframe);
  archive.items(task.inbetweens, [](auto& to, auto& totals) { pass_totals(to, totals); });
}

struct TableSurface {
  wire::MadeSurface surface;
  std::vector<wire::SurfaceLine> lines;
};

template <typename Archive, typename Of>
void pass_surface(Archive& archive, Of& item) {
  auto& surface = item.surface;
  archive.whole(surface.kind);
  for (auto* number : {&surface.bent, &surface.vertices, &surface.triangles_tested, &surface.colored,
                       &surface.triangles, &surface.edge_boxes, &surface.first_line})
    archive.whole(*number);
  archive.items(item.lines,
                [](auto& to, auto& line) { to.whole(line.edge_boxes), to.whole(line.begin), to.whole(line.go_on); });
}

void write_table(Writer& writer, const SurfaceTable& table) {
  writer.whole(table.size());
  for (std::uint32_t place = 0; place < table.size(); ++place) {
    const auto lines = table.lines(place);
    const TableSurface item{table[place], {lines.begin(), lines.end()}};
    pass_surface(writer, item);
  }
}

SurfaceTable read_table(Reader& reader) {
  std::uint32_t count = 0;
  reader.whole(count);
  SurfaceTable table;
  TableSurface item;
  for (std::uint32_t place = 0; place < count; ++place) {
    pass_surface(reader, item);
    item.surface.lines = static_cast<std::uint32_t>(item.lines.size());
    if (table.add(item.surface, item.lines) != place) reader.refuse_numbers();
  }
  return table;
}

// Whether counts are of the tasks of that film, so that whoever uses them finds all that they name.
class Sense {
 public:
  Sense(const FilmCounts& counts, std::span<const farm::Task> tasks, const wire::FilmSettings& settings)
      : counts_(counts), tasks_(tasks), height_(settings.height), columns_(blocks(settings.width)) {}

  bool is_there() const {
    return std::ranges::equal(counts_.tasks, tasks_,
                              [&](const auto& counted, const auto& task) { return is_of(counted, task); }) &&
           std::ranges::all_of(counts_.keyframes, [&](const auto& keyframe) { return is_keyframe(keyframe); });
  }

 private:
  static std::uint32_t blocks(std::uint32_t pixels) { return (pixels - 1) / wire::kCountedBlock + 1; }

  bool is_of(const TaskCounts& counted, const farm::Task& task) const {
    return counted.keyframe < counts_.keyframes.size() && counted.inbetweens.size() + 1 == task.frames.size() &&
           std::ranges::all_of(counted.inbetweens, [&](const auto& totals) { return are_blocks(totals.blocks); });
  }
  bool is_keyframe(const KeyframeCounts& keyframe) const {
    return keyframe.lines.size() == height_ && are_blocks(keyframe.constant_blocks) &&
           are_blocks(keyframe.moving_blocks) && are_lines(keyframe.first_still_line, keyframe.last_still_line) &&
           std::ranges::all_of(keyframe.casters,
                               [](const auto& caster) { return caster.diced_by <= wire::DicedBy::shadows; }) &&
           std::ranges::all_of(keyframe.placed, [&](const auto& placed) { return is_placed(placed); });
  }
  bool are_lines(std::uint32_t first, std::uint32_t last) const { return first <= last && last <= height_; }
  bool are_blocks(std::span<const wire::BlockStretch> blocks) const {
    return std::ranges::all_of(blocks, [&](const wire::BlockStretch& stretch) {
      return stretch.row < Sense::blocks(height_) && stretch.first < stretch.last && stretch.last <= columns_;
    });
  }
  bool is_placed(const PlacedSurface& placed) const {
    if (placed.surface >= counts_.surfaces.size()) return false;
    const wire::MadeSurface& surface = counts_.surfaces[placed.surface];
    return surface.kind <= wire::kLastSurfaceKind && std::uint64_t{surface.first_line} + surface.lines <= height_;
  }

  const FilmCounts& counts_;
  const std::span<const farm::Task> tasks_;
  const std::uint32_t height_;
  const std::uint32_t columns_;  // of blocks
};

std::string body_of(const FilmCounts& counts) {
  std::string body;
  Writer writer(body);
  write_table(writer, counts.surfaces);
  writer.items(counts.keyframes, [](auto& to, auto& keyframe) { pass_keyframe(to, keyframe); });
  writer.items(counts.tasks, [](auto& to, auto& task) { pass_task(to, task); });
  writer.whole(counts.counted);
  return body;
}

template <typename Number>
void add(document::Checksum& checksum, std::span<const Number> numbers) {
  checksum.add(std::as_bytes(numbers));
}

}  // namespace

std::string counted_content(std::span<const std::byte> block, std::span<const farm::Task> tasks,
                            const wire::PackedFilm& film, images::PictureFormat format) {
  const images::PictureBands bands(format, film.settings().width, film.settings().height);
  const std::array<std::uint32_t, 2> program{wire::kPixelVersion, bands.lines_a_band()};
  document::Checksum checksum;
  checksum.add(block);
  add<std::uint32_t>(checksum, program);
  for (const farm::Task& task : tasks) {
    add<std::uint32_t>(checksum, std::array{task.interval, static_cast<std::uint32_t>(task.frames.size())});
    add<std::uint32_t>(checksum, task.frames);
  }
  return checksum.digits();
}

void save_counts(const FilmCounts& counts, const std::string& content, const std::filesystem::path& path) {
  const std::string body = body_of(counts);
  Header header{kMagic, kVersion, kByteOrder, body.size(), digits(content), {}};
  header.checksum = checksum_over(header, body);
  document::write_whole_file(path, [&](const document::Write& write) {
    write({reinterpret_cast<const char*>(&header), sizeof header});
    write(body);
  });
}

FilmCounts read_counts(std::string_view numbers, const std::filesystem::path& path, std::span<const farm::Task> tasks,
                       const wire::PackedFilm& film) {
  Reader reader(numbers, path);
  FilmCounts counts;
  counts.surfaces = read_table(reader);
  reader.items(counts.keyframes, [](auto& from, auto& keyframe) { pass_keyframe(from, keyframe); });
  reader.items(counts.tasks, [](auto& from, auto& task) { pass_task(from, task); });
  reader.whole(counts.counted);
  counts.is_exact = true;
  if (!reader.is_at_end() || !Sense(counts, tasks, film.settings()).is_there()) reader.refuse_numbers();
  return counts;
}

FilmCounts load_counts(const std::filesystem::path& path, const std::string& content, std::span<const farm::Task> tasks,
                       const wire::PackedFilm& film) {
  const std::string bytes = document::read_file(path);
  Header header;
  if (bytes.size() < sizeof header || !bytes.starts_with(std::string_view(kMagic.data(), kMagic.size())))
    throw Failure("is no file of counts", path.string(), "name another file, or one that is not there yet");
  std::memcpy(&header, bytes.data(), sizeof header);
  if (header.version != kVersion || header.byte_order != kByteOrder)
    refuse(path, "has counts of another version of MARS");
  const std::string_view body = std::string_view(bytes).substr(sizeof header);
  if (header.bytes != body.size() || header.checksum != checksum_over(header, body)) refuse(path, "is damaged");
  if (header.content != digits(content)) refuse(path, "has counts of another film, of other frames or for other files");
  return read_counts(body, path, tasks, film);
}

}  // namespace mars::forecast
