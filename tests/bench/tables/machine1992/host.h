// The host of the 1992 program (thesis 4.10): puts strips on the screen, over a saved background.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "node/wire/film.h"
#include "tests/bench/tables/machine1992/messages.h"
#include "tests/bench/tables/machine1992/work.h"

namespace mars::machine1992 {

class Host {
 public:
  // Whole pictures, as the product has them: a word a pixel.
  using Show = std::function<void(std::uint32_t frame, const std::vector<std::uint32_t>& screen)>;

  Host(const wire::PackedFilm& film, Show show);

  // As Node::draw_interval.
  void show_interval(std::uint32_t interval, std::uint32_t inbetweens);

  // Of each frame, in their order.
  const std::vector<WorkCounts>& work() const { return work_; }

 private:
  void show_keyframe(std::uint32_t frame, std::uint32_t strips);
  void show_inbetween(std::uint32_t frame);
  StripHead receive(long type);
  void write_constant(const StripHead& head);
  void write_moving(const StripHead& head);
  void restore();
  const std::uint32_t* pixels() const { return received_.data() + sizeof(StripHead) / 4; }

  wire::PackedFilm film_;
  Show show_;
  std::uint32_t plain_ = 0;  // the interval's background pixel
  std::vector<std::uint32_t> received_;
  std::vector<std::uint32_t> background_;  // the CFB as it is shown
  std::vector<std::uint32_t> screen_;
  std::vector<std::uint8_t> written_;  // of each block of kBlock pixels of a line: by moving parts
  std::vector<WorkCounts> work_;
};

}  // namespace mars::machine1992
