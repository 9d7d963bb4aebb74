#include "host/content/film/frame_set.h"

#include <algorithm>
#include <charconv>
#include <limits>
#include <set>
#include <string_view>

#include "hal/failure/failure.h"

namespace mars::film {

namespace {

constexpr const char* kForm = "frames are written like 0-9,24,30-, or 0-99x5 for every fifth";

Failure wrong(std::string_view part, const std::string& reason) {
  return Failure("'" + std::string(part) + "' " + reason, "", kForm);
}

std::uint32_t number(std::string_view text, std::string_view part) {
  std::uint32_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc::result_out_of_range) throw wrong(part, "is too large for a frame number");
  if (error != std::errc() || end != text.data() + text.size())
    throw wrong(part, "is not a frame or a range of frames");
  return value;
}

FrameSet::Stretch stretch(std::string_view part) {
  const std::size_t dash = part.find('-');
  if (dash == std::string_view::npos) return {number(part, part), number(part, part)};
  FrameSet::Stretch stretch{number(part.substr(0, dash), part), std::nullopt};
  const std::string_view end = part.substr(dash + 1);
  const std::size_t times = end.find('x');
  if (const std::string_view last = end.substr(0, times); !last.empty()) stretch.last = number(last, part);
  if (times != std::string_view::npos) stretch.step = number(end.substr(times + 1), part);
  if (stretch.last && *stretch.last < stretch.first) throw wrong(part, "ends before it begins");
  if (stretch.step == 0) throw wrong(part, "has a step of 0");
  return stretch;
}

bool is_one_frame(const FrameSet::Stretch& stretch) { return stretch.last == stretch.first; }

// How many of the stretches from `at` on are one frame each, equally far apart.
std::size_t equal_steps(std::span<const FrameSet::Stretch> stretches, std::size_t at) {
  std::size_t end = at;
  while (end < stretches.size() && is_one_frame(stretches[end]) &&
         (end < at + 2 ||
          stretches[end].first - stretches[end - 1].first == stretches[at + 1].first - stretches[at].first))
    ++end;
  return end - at;
}

// A long list of every Nth frame has a short text.
std::vector<FrameSet::Stretch> with_steps(std::span<const FrameSet::Stretch> stretches) {
  constexpr std::size_t kFewest = 4;
  std::vector<FrameSet::Stretch> all;
  for (std::size_t at = 0; at < stretches.size();) {
    const std::size_t count = equal_steps(stretches, at);
    all.push_back(stretches[at]);
    if (count < kFewest) {
      ++at;
      continue;
    }
    all.back().last = stretches[at + count - 1].first;
    all.back().step = stretches[at + 1].first - stretches[at].first;
    at += count;
  }
  return all;
}

}  // namespace

FrameSet::FrameSet(const std::string& text) {
  std::string_view rest = text;
  while (true) {
    const std::size_t comma = rest.find(',');
    stretches_.push_back(stretch(rest.substr(0, comma)));
    if (comma == std::string_view::npos) return;
    rest.remove_prefix(comma + 1);
  }
}

FrameSet::FrameSet(std::span<const std::uint32_t> frames) {
  for (const std::uint32_t frame : frames) {
    if (!stretches_.empty() && std::uint64_t{*stretches_.back().last} + 1 == frame)
      stretches_.back().last = frame;
    else
      stretches_.push_back({frame, frame});
  }
  stretches_ = with_steps(stretches_);
}

FrameSet FrameSet::every(std::uint32_t step) const {
  FrameSet some = *this;
  constexpr std::uint64_t kMost = std::numeric_limits<std::uint32_t>::max();
  for (Stretch& stretch : some.stretches_)
    if (!is_one_frame(stretch))
      stretch.step = static_cast<std::uint32_t>(std::min(kMost, std::uint64_t{stretch.step} * step));
  return some;
}

std::string FrameSet::text() const {
  std::string text;
  for (const Stretch& stretch : stretches_) {
    if (!text.empty()) text += ',';
    text += std::to_string(stretch.first);
    if (stretch.last == stretch.first) continue;
    text += '-';
    if (stretch.last) text += std::to_string(*stretch.last);
    if (stretch.step != 1) text += 'x' + std::to_string(stretch.step);
  }
  return text;
}

std::vector<std::uint32_t> FrameSet::of_film(std::uint32_t film_frames) const {
  std::vector<bool> wanted(film_frames);
  for (const Stretch& stretch : stretches_) {
    const std::uint32_t last = stretch.last.value_or(film_frames - 1);
    const std::uint32_t beyond = stretch.first < film_frames ? last : stretch.first;
    if (beyond >= film_frames) {
      throw Failure("frame " + std::to_string(beyond) + " is beyond the film's last, " +
                        std::to_string(film_frames - 1),
                    "--frames " + text(), "frames count from 0");
    }
    for (std::uint64_t frame = stretch.first; frame <= last; frame += stretch.step) wanted[frame] = true;
  }
  std::vector<std::uint32_t> frames;
  for (std::uint32_t frame = 0; frame < film_frames; ++frame) {
    if (wanted[frame]) frames.push_back(frame);
  }
  return frames;
}

bool FrameSet::is_small_part(std::uint32_t film_frames) const {
  return *this != FrameSet() && of_film(film_frames).size() <= film_frames / 4;
}

std::vector<std::uint32_t> FrameSet::first_frames(std::uint32_t count) const {
  std::set<std::uint32_t> frames;
  for (const Stretch& stretch : stretches_) {
    const std::uint32_t most =
        stretch.last ? std::min(count, (*stretch.last - stretch.first) / stretch.step + 1) : count;
    for (std::uint32_t i = 0; i < most; ++i) frames.insert(stretch.first + i * stretch.step);
  }
  std::vector<std::uint32_t> first(frames.begin(), frames.end());
  first.resize(std::min<std::size_t>(first.size(), count));
  return first;
}

std::string frames_text(std::span<const std::uint32_t> frames) {
  return (frames.size() == 1 ? "frame " : "frames ") + FrameSet(frames).text();
}

}  // namespace mars::film
