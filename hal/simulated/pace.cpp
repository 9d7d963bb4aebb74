#include "hal/simulated/pace.h"

#include <cmath>
#include <initializer_list>

namespace mars::simulated {
namespace {

constexpr double kMany = 1e6;  // detours

// What is drawn.
enum Draw : std::uint64_t { kStraggles, kSlowness, kMoment, kLength };

// 0 or more, below 1, from the numbers alone: scrambled as by splitmix64 (Steele, Lea and Flood, 2014).
double drawn(std::initializer_list<std::uint64_t> numbers) {
  std::uint64_t mixed = 0;
  for (const std::uint64_t number : numbers) {
    mixed += number + 0x9e3779b97f4a7c15u;
    mixed = (mixed ^ mixed >> 30) * 0xbf58476d1ce4e5b9u;
    mixed = (mixed ^ mixed >> 27) * 0x94d049bb133111ebu;
    mixed ^= mixed >> 31;
  }
  return static_cast<double>(mixed >> 11) * 0x1p-53;
}

double speed_of(const std::vector<SpeedKind>& kinds, int computer) {
  std::int64_t all = 0;
  for (const SpeedKind& kind : kinds) all += kind.computers;
  if (all == 0) return 1;
  std::int64_t place = computer % all;
  for (const SpeedKind& kind : kinds)
    if ((place -= kind.computers) < 0) return kind.speed;
  return 1;
}

double straggling(const Noise& noise, int computer) {
  const auto number = static_cast<std::uint64_t>(computer);
  if (drawn({noise.seed, kStraggles, number}) >= noise.stragglers) return 1;
  return noise.least_slowdown + (noise.most_slowdown - noise.least_slowdown) * drawn({noise.seed, kSlowness, number});
}

}  // namespace

Pace::Pace(const Machine& machine, int computers) : machine_(machine) {
  for (int computer = 0; computer < computers; ++computer)
    slowness_.push_back(straggling(machine.noise, computer) / speed_of(machine.speeds, computer));
  slowness_.push_back(1 / machine.host_speed);
}

double Pace::end(Processor processor, double begin, double seconds) const {
  seconds *= slowness_[static_cast<std::size_t>(processor.computer)];
  if (machine_.slowness) seconds *= machine_.slowness(processor.computer, begin);
  return machine_.noise.detours > 0 ? after_detours(processor, begin, begin + seconds) : begin + seconds;
}

// In each stretch of 1 / detours seconds there is one. It counts where work goes on at its moment. Of very many, the
// mean counts.
double Pace::after_detours(Processor processor, double begin, double end) const {
  const Noise& noise = machine_.noise;
  if ((end - begin) * noise.detours > kMany) return begin + (end - begin) / (1 - noise.detours * noise.detour);
  for (auto stretch = static_cast<std::uint64_t>(begin * noise.detours);
       static_cast<double>(stretch) < end * noise.detours; ++stretch) {
    const auto draw = [&](Draw what) {
      return drawn({noise.seed, what, static_cast<std::uint64_t>(processor.computer),
                    static_cast<std::uint64_t>(processor.number), stretch});
    };
    const double moment = (static_cast<double>(stretch) + draw(kMoment)) / noise.detours;
    if (moment < begin || moment >= end) continue;
    end += noise.detour * (noise.lengths == Lengths::exponential ? -std::log1p(-draw(kLength)) : 1);
  }
  return end;
}

}  // namespace mars::simulated
