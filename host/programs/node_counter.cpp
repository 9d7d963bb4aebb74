#include "host/programs/node_counter.h"

#include "node/frame_counter.h"
#include "node/simd/instruction_set.h"

namespace mars::programs {
namespace {

class NodeCounter : public forecast::Counter {
 public:
  NodeCounter(const wire::PackedFilm& film, forecast::Lines lines)
      : counter_(film, simd::best_instruction_set(""), lines == forecast::Lines::all) {}

  wire::FrameCounts count_keyframe(const farm::Task& task) override {
    return counter_.count_keyframe(task.interval, task.frames);
  }
  wire::FrameCounts count_inbetween(std::uint32_t frame) override { return counter_.count_inbetween(frame); }

 private:
  node::FrameCounter counter_;
};

}  // namespace

std::unique_ptr<forecast::Counter> make_node_counter(const wire::PackedFilm& film, forecast::Lines lines) {
  return std::make_unique<NodeCounter>(film, lines);
}

}  // namespace mars::programs
