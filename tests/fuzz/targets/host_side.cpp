// All that nodes send a host, from their greeting to the last strip: the input says how a sound rendering's messages
// are changed. The host renders, or refuses one with a Failure.
#include <array>
#include <memory>

#include "hal/failure/failure.h"
#include "hal/messages/process.h"
#include "host/render/trace/trace.h"
#include "tests/fuzz/recorded_job.h"
#include "tests/fuzz/target.h"

namespace mars::fuzz::host_side {

void take(std::string_view input) {
  constexpr std::uint32_t kSamples = 2;
  constexpr auto kLayered = wire::with_layers(wire::PixelFormat::half_alpha, wire::kAllLayers, kSamples);
  static const std::array<RecordedJob, 3> jobs{RecordedJob(1, wire::PixelFormat::rgb8, false),
                                               RecordedJob(4, wire::PixelFormat::half, true),
                                               RecordedJob(kSamples, kLayered, false)};
  Script script(input);
  const RecordedJob& job = jobs[script.below(jobs.size())];
  DeadPeers peers(kNodes, kNodes);
  const bool sound = script.at_end();
  hand_changed(job.letters_to(kNodes), script, peers);
  test::RunOptions options = job.options();
  trace::Trace trace(1000);
  if (job.traced()) options.farm.trace = &trace;
  messages::Process process(peers);
  try {
    test::render_as_host(job.film().bytes(), options);
  } catch (const NothingComes&) {
    check(!sound, "a sound rendering ends");
  }
}

const Target target("host_side", Form::bytes, take);

}  // namespace mars::fuzz::host_side
