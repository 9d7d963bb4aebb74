#include "tests/bench/tables/machine1992/host.h"

#include <algorithm>
#include <utility>

#include "hal/nx/nx_messages.h"
#include "node/color/encoding.h"

namespace mars::machine1992 {
namespace {

constexpr std::size_t kBlock = 16;  // pixels of a line that share a flag

}  // namespace

Host::Host(const wire::PackedFilm& film, Show show)
    : film_(film),
      show_(std::move(show)),
      received_(sizeof(StripHead) / 4 + std::size_t{film.settings().width} * film.settings().height),
      background_(std::size_t{film.settings().width} * film.settings().height),
      screen_(background_.size()),
      written_((screen_.size() + kBlock - 1) / kBlock) {}

void Host::show_interval(std::uint32_t number, std::uint32_t inbetweens) {
  const wire::Interval& interval = film_.intervals()[number];
  const auto encoding =
      color::encoding_of(film_.settings(), film_.camera_at(interval.first_frame), wire::PixelFormat::rgb8);
  plain_ = static_cast<std::uint32_t>(color::pixel_of(encoding, film_.settings().background.data()));
  const auto nodes = static_cast<std::uint32_t>(numnodes());
  show_keyframe(interval.first_frame, interval.moving_count > 0 ? 2 * nodes : nodes);
  csend(kGoOn, nullptr, 0, -1, 0);
  for (std::uint32_t k = 0; k < inbetweens; ++k) show_inbetween(interval.first_frame + 1 + k);
}

void Host::show_keyframe(std::uint32_t frame, std::uint32_t strips) {
  work_.emplace_back();
  std::ranges::fill(written_, std::uint8_t{0});
  for (std::uint32_t k = 0; k < strips; ++k) {
    const StripHead head = receive(kKeyframe);
    head.moving == 1 ? write_moving(head) : write_constant(head);
  }
  show_(frame, screen_);
}

void Host::show_inbetween(std::uint32_t frame) {
  work_.emplace_back();
  const StripHead head = receive(kInbetween + static_cast<long>(frame));
  restore();
  write_moving(head);
  show_(frame, screen_);
}

StripHead Host::receive(long type) {
  crecv(type, nullptr, 0);
  csend(kReady, nullptr, 0, infonode(), 0);
  crecv(kStrip, received_.data(), static_cast<long>(4 * received_.size()));
  StripHead head;
  std::copy_n(received_.data(), sizeof(head) / 4, reinterpret_cast<std::uint32_t*>(&head));
  return head;
}

// A node's CFB comes before its MFB.
void Host::write_constant(const StripHead& head) {
  const std::uint32_t* from = pixels();
  const std::size_t first = std::size_t{head.first_line} * film_.settings().width,
                    last = std::size_t{head.last_line} * film_.settings().width;
  for (std::size_t at = first; at < last; ++at, ++from)
    screen_[at] = background_[at] = *from != 0 ? *from & ~kDrawn : plain_;
  WorkCounts work;
  work[Work::copy] = last - first;
  spend(work, work_.back());
}

void Host::write_moving(const StripHead& head) {
  WorkCounts work;
  const std::uint32_t* from = pixels();
  for (std::uint32_t line = head.first_line; line < head.last_line; ++line) {
    const std::size_t begin = std::size_t{line} * film_.settings().width;
    for (std::size_t at = begin + head.first_column; at < begin + head.last_column; ++at, ++from) {
      ++work[Work::look];
      if (*from == 0) continue;
      screen_[at] = *from & ~kDrawn;
      written_[at / kBlock] = 1;
      ++work[Work::copy];
    }
  }
  spend(work, work_.back());
}

void Host::restore() {
  WorkCounts work;
  for (std::size_t block = 0; block < written_.size(); ++block) {
    if (std::exchange(written_[block], std::uint8_t{0}) == 0) continue;
    const std::size_t first = block * kBlock, count = std::min(kBlock, screen_.size() - first);
    std::copy_n(background_.begin() + static_cast<std::ptrdiff_t>(first), count,
                screen_.begin() + static_cast<std::ptrdiff_t>(first));
    work[Work::copy] += count;
  }
  work[Work::look] = written_.size();
  spend(work, work_.back());
}

}  // namespace mars::machine1992
