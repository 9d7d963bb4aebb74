#include "host/render/farm/node_rates.h"

#include <algorithm>
#include <numeric>
#include <numeric>
#include <utility>

namespace mars::farm {
namespace {

// A pace is taken over at least this many inbetweens and seconds, so that neither single inbetweens nor what else a
// machine does for a moment decide it.
constexpr int kInbetweens = 2;
constexpr double kSeconds = 2;

constexpr double kSlow = 1.5;       // from here on a node may be slow
constexpr std::size_t kDoubts = 3;  // and is, after this number of times
constexpr double kUsual = 1.25;     // up to here it no longer is
constexpr int kPassedOver = 32;     // portions

}  // namespace

void NodeRates::ready(int number, double now) {
  Node& node = of(number);
  node.since = std::max(node.since, now);
}

void NodeRates::came(int number, double now, double seconds, double work) {
  Node& node = of(number);
  ++node.inbetweens;
  node.seconds += std::max(now - node.since, seconds);
  node.work += work;
  node.since = now;
  node.passed_over = 0;
  if (node.inbetweens >= kInbetweens && node.seconds >= kSeconds) take_pace(number, now);
}

void NodeRates::given(int number, bool some) {
  Node& node = of(number);
  node.passed_over = some ? 0 : node.passed_over + 1;
}

bool NodeRates::is_forgotten(int node) const { return of(node).slowness > 1 && of(node).passed_over >= kPassedOver; }

std::vector<int> NodeRates::take_changed() { return std::exchange(changed_, {}); }

// As it was taken last; before, as it is so far.
std::optional<double> NodeRates::pace_of(const Node& node) {
  if (node.pace || node.inbetweens < kInbetweens) return node.pace;
  return node.seconds / node.work;
}

// The median; of two nodes the faster one's.
double NodeRates::usual_pace() const {
  std::vector<double> paces;
  for (const Node& node : nodes_)
    if (const auto pace = pace_of(node)) paces.push_back(*pace);
  const auto median = paces.begin() + static_cast<std::ptrdiff_t>((paces.size() - 1) / 2);
  std::nth_element(paces.begin(), median, paces.end());
  return *median;
}

void NodeRates::take_pace(int number, double now) {
  Node& node = of(number);
  node.pace = node.seconds / node.work;
  node.inbetweens = 0;
  node.seconds = node.work = 0;
  const double slowness = *node.pace / usual_pace();
  if (node.slowness > 1)
    smooth(number, slowness, now);
  else
    doubt(number, slowness, now);
}

void NodeRates::doubt(int number, double slowness, double now) {
  Node& node = of(number);
  if (slowness < kSlow) return node.doubts.clear();
  node.doubts.push_back(slowness);
  if (node.doubts.size() < kDoubts) return;
  node.slowness = std::accumulate(node.doubts.begin(), node.doubts.end(), 0.0) / kDoubts;
  node.doubts.clear();
  slow_times_.push_back({number, node.slowness, now});
  changed_.push_back(number);
}

// Of a slow node.
void NodeRates::smooth(int number, double slowness, double now) {
  Node& node = of(number);
  SlowTime& time = *std::ranges::find_if(slow_times_, [&](const SlowTime& t) { return t.node == number && !t.end; });
  node.slowness = (node.slowness + slowness) / 2;
  time.slowness = std::max(time.slowness, node.slowness);
  if (node.slowness > kUsual) return;
  node.slowness = 1;
  time.end = now;
  changed_.push_back(number);
}

double work_of(const wire::WorkCounts& counts) {
  const auto units = [](double each, std::uint64_t count) { return each * static_cast<double>(count); };
  const auto charged = [&](wire::Work kind) { return counts.charged[static_cast<std::size_t>(kind)]; };
  return 40'000 + units(900, counts.patches) + units(6, counts.vertices) + units(1.2, counts.triangles_tested) +
         units(12, counts.triangles) + units(6, counts.edge_boxes_diced) + units(8.5, counts.edge_boxes) +
         units(0.2, counts.samples) + units(15, counts.pixels) + units(63, charged(wire::Work::casting_light)) +
         units(55, charged(wire::Work::shadow_point)) + units(2'300, charged(wire::Work::caster)) +
         units(29, charged(wire::Work::caster_vertex)) + units(21, charged(wire::Work::caster_triangle));
}

}  // namespace mars::farm
