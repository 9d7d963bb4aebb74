#include "host/render/composer/node_writer.h"

#include <algorithm>
#include <cstring>
#include <system_error>
#include <utility>

#include "hal/failure/failure.h"
#include "host/content/document/whole_file.h"
#include "host/images/encode_bands.h"
#include "host/render/sinks/frame_mark.h"
#include "host/render/sinks/pixel_hash.h"

namespace mars::composer {
namespace {

struct EdgeHead {
  std::uint32_t band;
  std::uint32_t interval;
  images::Lines lines;
  std::uint32_t is_touched;  // 1: pixels without moving parts are followed by those with them
  std::uint32_t unused;
};

void require(bool holds, const char* what) {
  if (!holds) throw Failure(std::string(what) + " of another node do not make sense", "", "please report it");
}

images::Lines lines_of(const wire::LineSpan& span) { return {span.first, span.end}; }

images::PictureBands bands_for(const wire::PackedFilm& film, const sinks::WriterOrders& orders) {
  images::PictureBands bands = sinks::bands_of(orders.manifest);
  bands.set_film(film);
  return bands;
}

void append(std::vector<std::byte>& to, std::span<const std::byte> bytes) {
  to.insert(to.end(), bytes.begin(), bytes.end());
}

void copy_bytes(std::span<const std::byte> from, std::span<std::uint32_t> to) {
  std::memcpy(to.data(), from.data(), to.size_bytes());
}

}  // namespace

NodeWriter::NodeWriter(const wire::PackedFilm& film, const sinks::WriterOrders& orders, std::int32_t node,
                       bool is_first)
    : orders_(orders),
      bands_(bands_for(film, orders)),
      content_(film, orders.manifest.layers),
      composer_(bands_),
      background_(bands_),
      drawn_(bands_.count()),
      files_(
          node, [this](std::uint32_t frame) { return orders_.file_of(frame); },
          [this](const FrameFile& file) { put(file); }) {
  sees_folder_ = sinks::appears(orders_.host_probe());
  if (sees_folder_ && is_first) document::create_file(orders_.node_probe(node), "");
}

void NodeWriter::begin_keyframe(const Keyframe& keyframe) {
  keyframe_ = keyframe;
  frame_ = keyframe.frame;
  is_keyframe_ = true;
  for (auto* message : {&edge_, &background_message_, &picture_message_}) message->clear();
  pictures_.clear();
  background_given_ = 0;
  shared_.lines = 0;
  composer_.begin_keyframe(lines_of(keyframe.home), keyframe.background,
                           [this](const BandComposer::Part& part) { take_keyframe_part(part); });
}

void NodeWriter::begin_inbetween(std::uint32_t frame, const wire::LineSpan& home) {
  frame_ = frame;
  is_keyframe_ = false;
  pictures_.clear();
  for (std::vector<std::byte>& record : drawn_) record.clear();
  composer_.begin_inbetween(
      lines_of(home),
      [this](std::uint32_t band) {
        check(inbetweens_touch(band), "inbetweens draw where they were foreseen");
        return background_.pixels(band);
      },
      [this](const BandComposer::Part& part) {
        append_record(drawn_[part.band], bands_, part.band, keyframe_.interval, part.whole);
      });
}

void NodeWriter::paste(const wire::Strip& strip, std::span<const wire::Run> runs,
                       std::span<const std::uint32_t> pixels) {
  composer_.paste(strip.last_line, runs, strip.constant_runs, pixels);
}

void NodeWriter::take_keyframe_part(const BandComposer::Part& part) {
  const images::Lines all = bands_.lines_of(part.band);
  if (part.lines.first != all.first) return make_edge(part);
  if (part.lines.end != all.end) return keep_shared_band(part);
  finish_band(part.band, part.is_touched, part.still, part.whole);
}

void NodeWriter::make_edge(const BandComposer::Part& part) {
  const EdgeHead head{part.band, keyframe_.interval, part.lines, part.is_touched ? 1u : 0u, 0};
  append(edge_, std::as_bytes(std::span(&head, 1)));
  append(edge_, std::as_bytes(part.still));
  if (part.is_touched) append(edge_, std::as_bytes(part.whole));
}

void NodeWriter::keep_shared_band(const BandComposer::Part& part) {
  const std::size_t words = bands_.words_of(bands_.lines_of(part.band));
  shared_.part = part;
  shared_.lines = part.lines.count();
  shared_.is_touched = part.is_touched;
  shared_.still.assign(part.still.begin(), part.still.end());
  shared_.whole.assign(part.whole.begin(), part.whole.end());
  shared_.still.resize(words);
  shared_.whole.resize(words);
}

void NodeWriter::add_edge(std::span<const std::byte> edge) {
  constexpr const char* kWhat = "lines of a band";
  EdgeHead head{};
  require(edge.size() >= sizeof head && shared_.lines > 0, kWhat);
  std::memcpy(&head, edge.data(), sizeof head);
  const images::Lines all = bands_.lines_of(shared_.part.band);
  require(head.band == shared_.part.band && head.interval == keyframe_.interval, kWhat);
  require(head.lines.first >= shared_.part.lines.end && head.lines.first < head.lines.end && head.lines.end <= all.end,
          kWhat);
  const std::size_t first = bands_.words_of({all.first, head.lines.first}), count = bands_.words_of(head.lines);
  const std::size_t bytes = count * sizeof(std::uint32_t);
  require(edge.size() == sizeof head + bytes * (head.is_touched == 1 ? 2 : 1), kWhat);
  copy_bytes(edge.subspan(sizeof head, bytes), std::span(shared_.still).subspan(first, count));
  copy_bytes(edge.last(bytes), std::span(shared_.whole).subspan(first, count));
  shared_.is_touched |= head.is_touched == 1;
  shared_.lines += head.lines.count();
}

void NodeWriter::finish_bands() {
  if (shared_.lines == 0) return;
  const std::uint32_t band = shared_.part.band;
  require(shared_.lines == bands_.lines_of(band).count(), "lines of a band");
  finish_band(band, shared_.is_touched, shared_.still, shared_.whole);
}

void NodeWriter::finish_band(std::uint32_t band, bool is_touched, std::span<const std::uint32_t> still,
                             std::span<const std::uint32_t> whole) {
  const std::size_t before = picture_message_.size();
  append_record(picture_message_, bands_, band, keyframe_.interval, whole);
  if (!keyframe_.has_inbetweens) return;
  const std::size_t at = background_message_.size();
  if (is_touched)
    append_record(background_message_, bands_, band, keyframe_.interval, still);
  else
    append(background_message_, std::span(picture_message_).subspan(before));
  std::span<const std::byte> bytes = std::span(background_message_).subspan(at);
  const std::optional<ReadRecord> own = take_record(bytes, bands_);
  const bool needs_pixels = inbetweens_touch(band);
  background_.put(own->record, needs_pixels ? std::as_bytes(still) : std::span<const std::byte>());
  if (!needs_pixels) return;
  const std::uint64_t words = still.size();
  std::memcpy(background_message_.data() + at + offsetof(BandHead, pixels), &words, sizeof words);
  append(background_message_, std::as_bytes(still));
  background_message_.resize((background_message_.size() + 7) / 8 * 8);
}

bool NodeWriter::inbetweens_touch(std::uint32_t band) const {
  const images::Lines lines = bands_.lines_of(band);
  return lines.first < keyframe_.touched.end && keyframe_.touched.first < lines.end;
}

std::span<const std::byte> NodeWriter::next_background(std::size_t bytes) {
  const std::span<const std::byte> left = std::span(background_message_).subspan(background_given_);
  std::size_t given = 0;
  for (std::span<const std::byte> rest = left; !rest.empty();) {
    take_record(rest, bands_);
    const std::size_t with_it = left.size() - rest.size();
    if (given > 0 && with_it > bytes) break;
    given = with_it;
  }
  background_given_ += given;
  return left.first(given);
}

void NodeWriter::add_background(std::span<const std::byte> background) {
  while (!background.empty()) {
    const std::optional<ReadRecord> read = take_record(background, bands_);
    require(read && read->record.head.interval == keyframe_.interval, "bands");
    require(read->pixels.empty() != inbetweens_touch(read->record.head.band), "pixels of a band");
    background_.put(read->record, read->pixels);
  }
}

// Of an inbetween the bands that moving parts touch.
std::span<const std::byte> NodeWriter::picture() {
  if (is_keyframe_) return picture_message_;
  picture_message_.clear();
  for (const std::vector<std::byte>& record : drawn_) append(picture_message_, record);
  return picture_message_;
}

void NodeWriter::add_picture(std::span<const std::byte> picture) {
  pictures_.emplace_back(picture.begin(), picture.end());
}

std::vector<BandRecord> NodeWriter::records() const {
  std::vector<BandRecord> all(bands_.count());
  std::size_t there = 0;
  const auto add = [&](std::span<const std::byte> message) {
    while (!message.empty()) {
      const std::optional<ReadRecord> read = take_record(message, bands_);
      require(read && read->record.head.interval == keyframe_.interval, "bands");
      BandRecord& band = all[read->record.head.band];
      there += band.encoded.empty();
      band = read->record;
    }
  };
  for (const std::vector<std::byte>& message : pictures_) add(message);
  if (!is_keyframe_) {
    for (std::uint32_t band = 0; band < bands_.count(); ++band) {
      add(drawn_[band]);
      if (!all[band].encoded.empty()) continue;
      const std::optional<BandRecord> still = background_.record(band, keyframe_.interval);
      require(still.has_value(), "bands");
      all[band] = *still;
      ++there;
    }
  }
  require(there == all.size(), "bands");
  return all;
}

void NodeWriter::write() {
  const std::vector<BandRecord> all = records();
  files_.write(file_of(all));
}

FrameFile NodeWriter::file_of(std::span<const BandRecord> records) {
  std::vector<images::BandPart> parts;
  std::vector<std::string> hashes;
  for (const BandRecord& record : records) {
    parts.push_back({record.encoded, record.head.adler32, record.head.row_bytes});
    hashes.emplace_back(record.head.hash, sizeof record.head.hash);
  }
  FrameFile file{frame_, sinks::hash_of_bands(hashes), files_.buffer()};
  const images::FileFacts facts = sinks::facts_in(orders_.manifest, frame_, file.pixel_hash, content_.checksum(frame_));
  const images::PictureEnds ends = images::ends_of(bands_, parts, facts);
  append(file.bytes, ends.before);
  for (const images::BandPart& part : parts) append(file.bytes, part.bytes);
  append(file.bytes, ends.after);
  return file;
}

// A run that has lost its claim writes no more: another may have the folder.
void NodeWriter::put(const FrameFile& file) const {
  std::error_code none;
  if (!std::filesystem::exists(orders_.claim(), none))
    throw Failure("the run has lost its claim to the folder", orders_.folder.string(),
                  "see what has removed it; the same command goes on");
  document::replace_file(orders_.file_of(file.frame), orders_.part_of(file.frame), document::Pieces{file.bytes});
}

}  // namespace mars::composer
