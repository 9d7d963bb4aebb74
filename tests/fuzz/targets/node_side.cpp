// All that the host and another node send a node, from the film to the last credit: the input says how a sound
// rendering's messages are changed. The node draws, or reports a fault and ends.
#include <array>

#include "hal/failure/failure.h"
#include "hal/messages/process.h"
#include "tests/fuzz/recorded_job.h"
#include "tests/fuzz/target.h"

namespace mars::fuzz::node_side {

void take(std::string_view input) {
  constexpr std::uint32_t kSamples = 2;
  constexpr auto kLayered = wire::with_layers(wire::PixelFormat::half_alpha, wire::kAllLayers, kSamples);
  static const std::array<RecordedJob, 3> jobs{RecordedJob(1, wire::PixelFormat::rgb8, false),
                                               RecordedJob(4, wire::PixelFormat::half, true),
                                               RecordedJob(kSamples, kLayered, false)};
  Script script(input);
  const RecordedJob& job = jobs[script.below(jobs.size())];
  const auto self = static_cast<int>(script.below(kNodes));
  DeadPeers peers(self, kNodes);
  const bool sound = script.at_end();
  hand_changed(job.letters_to(self), script, peers);
  messages::Process process(peers);
  try {
    test::run_as_node(job.options());
  } catch (const NothingComes&) {
    check(!sound, "a sound rendering ends");
  }
}

const Target target("node_side", Form::bytes, take);

}  // namespace mars::fuzz::node_side
