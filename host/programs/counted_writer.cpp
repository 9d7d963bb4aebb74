#include "host/programs/counted_writer.h"

#include <algorithm>

#include "hal/messages/process.h"
#include "host/render/composer/band_record.h"

namespace mars::programs {

using wire::Work;

CountedWriter::CountedWriter(const images::PictureBands& bands, const experiments::Platform& platform,
                             simulated::World& world, int node)
    : bands_(bands), platform_(platform), world_(world), node_(node), touched_(bands.count()) {}

void CountedWriter::charge(Work kind, std::uint64_t units) const { messages::charge(static_cast<int>(kind), units); }

void CountedWriter::begin_keyframe(const Keyframe& keyframe) {
  keyframe_ = keyframe;
  frame_ = keyframe.frame;
  touched_.assign(touched_.size(), false);
  for (auto* message : {&edge_, &background_, &picture_}) message->clear();
}

void CountedWriter::begin_inbetween(std::uint32_t frame, const wire::LineSpan&) {
  frame_ = frame;
  touched_.assign(touched_.size(), false);
}

// An inbetween's bands are composed and encoded where moving parts touch them.
void CountedWriter::paste(const wire::Strip& strip, std::span<const wire::Run> runs,
                          std::span<const std::uint32_t> pixels) {
  std::uint64_t newly_touched = 0;
  for (const wire::Run& run : runs.subspan(strip.constant_runs)) {
    const std::uint32_t band = bands_.band_of(run.line);
    if (!touched_[band]) newly_touched += pixel_bytes(bands_.lines_of(band));
    touched_[band] = true;
  }
  charge(Work::host_run, runs.size());
  charge(Work::host_byte, pixels.size_bytes());
  if (frame_ != keyframe_.frame) charge(experiments::encoded_byte(bands_.format()), newly_touched);
}

bool CountedWriter::composes(std::uint32_t band) const {
  const std::uint32_t first = bands_.lines_of(band).first;
  return keyframe_.home.first <= first && first < keyframe_.home.end;
}

bool CountedWriter::inbetweens_touch(std::uint32_t band) const {
  const images::Lines lines = bands_.lines_of(band);
  return lines.first < keyframe_.touched.end && keyframe_.touched.first < lines.end;
}

std::size_t CountedWriter::record_bytes(std::uint32_t band) const {
  return sizeof(composer::BandHead) +
         static_cast<std::size_t>(platform_.file_part * static_cast<double>(pixel_bytes(bands_.lines_of(band))));
}

std::span<const std::byte> CountedWriter::edge() {
  const std::uint32_t band = bands_.band_of(keyframe_.home.first);
  const images::Lines lines{keyframe_.home.first, std::min(keyframe_.home.end, bands_.lines_of(band).end)};
  edge_.resize(pixel_bytes(lines) * (touched_[band] ? 2 : 1));
  return edge_;
}

void CountedWriter::finish_bands() {
  std::size_t picture = 0;
  std::uint64_t encoded = 0;
  for (std::uint32_t band = 0; band < bands_.count(); ++band) {
    if (!composes(band)) continue;
    const std::size_t pixels = pixel_bytes(bands_.lines_of(band));
    picture += record_bytes(band);
    encoded += pixels;
    if (!keyframe_.has_inbetweens) continue;
    encoded += touched_[band] ? pixels : 0;
  }
  charge(experiments::encoded_byte(bands_.format()), encoded);
  picture_.resize(picture);
  next_background_ = 0;
  find_background();
}

std::size_t CountedWriter::background_bytes(std::uint32_t band) const {
  return record_bytes(band) + (inbetweens_touch(band) ? pixel_bytes(bands_.lines_of(band)) : 0);
}

std::size_t CountedWriter::most_band_bytes() const { return record_bytes(0) + pixel_bytes(bands_.lines_of(0)); }

void CountedWriter::find_background() {
  while (has_background() && !(keyframe_.has_inbetweens && composes(next_background_))) ++next_background_;
}

std::span<const std::byte> CountedWriter::next_background(std::size_t bytes) {
  std::size_t given = 0;
  while (has_background() && (given == 0 || given + background_bytes(next_background_) <= bytes)) {
    given += background_bytes(next_background_++);
    find_background();
  }
  background_.resize(given);
  return background_;
}

std::span<const std::byte> CountedWriter::picture() {
  if (frame_ == keyframe_.frame) return picture_;
  std::size_t bytes = 0;
  for (std::uint32_t band = 0; band < bands_.count(); ++band) bytes += touched_[band] ? record_bytes(band) : 0;
  picture_.resize(bytes);
  return picture_;
}

// A thread writes one file after another.
void CountedWriter::write() {
  const auto bytes =
      static_cast<std::uint64_t>(platform_.file_part * static_cast<double>(pixel_bytes({0, bands_.height()})));
  const double seconds = experiments::file_seconds(world_.machine(), bands_.format(), {1, 0, bytes});
  const double begun = under_way_.empty() ? now() : std::max(now(), under_way_.back().there);
  const double made = std::max(begun, world_.reserve(node_, seconds));
  const double there = world_.store(node_, made, static_cast<double>(bytes));
  under_way_.push_back({frame_, begun, there});
  world_.set_alarm(node_, there);
}

bool CountedWriter::is_full() {
  return std::ranges::count_if(under_way_, [this](const File& file) { return file.there > now(); }) >=
         static_cast<std::ptrdiff_t>(wire::kMostFilesUnderWay);
}

std::optional<wire::Written> CountedWriter::take_written() {
  if (!has_written()) return std::nullopt;
  const File file = under_way_.front();
  under_way_.pop_front();
  return wire::Written{file.frame, node_, {}, 0, file.there - file.begun};
}

}  // namespace mars::programs
