#include "host/render/walls/walls.h"

#include <algorithm>
#include <map>

namespace mars::walls {
namespace {

// Of a rendering's time: where no wall's gain is more, several bind together, and the longest is named.
constexpr double kNoGain = 0.02;
// A wall that takes less is none.
constexpr double kNothing = 1e-3;

// Work that is not evenly divided: parts of what work takes.
const Walls kUneven{Wall::imbalance, Wall::frame};

class Explainer {
 public:
  Explainer(const SecondsWithout& seconds, Walls there) : ask_(seconds), there_(there) {}

  Explanation explain();

 private:
  double seconds(Walls without) {
    const auto [found, fresh] = known_.try_emplace(without.number());
    if (fresh) found->second = ask_(without);
    return found->second;
  }
  double gain(Wall wall, Walls gone);
  double alone(Wall wall);
  std::optional<Wall> binding(Walls gone);

  const SecondsWithout& ask_;
  const Walls there_;
  std::map<unsigned long, double> known_;
};

// Of work: beyond what walls gain that are part of it.
double Explainer::gain(Wall wall, Walls gone) {
  const Walls beside = wall == Wall::compute ? gone.with(kUneven) : gone;
  return seconds(beside) - seconds(beside.with({wall}));
}

// What is uneven is work: beside evenly divided work.
double Explainer::alone(Wall wall) {
  if (!kUneven.has(wall)) return seconds(Walls::all().without({wall}));
  const Walls even = Walls::all().without({Wall::compute});
  return seconds(even.without({wall})) - seconds(even);
}

std::optional<Wall> Explainer::binding(Walls gone) {
  const std::vector<Wall> left = there_.without(gone).list();
  if (left.empty()) return std::nullopt;
  const Wall first = *std::ranges::max_element(left, {}, [&](Wall wall) { return gain(wall, gone); });
  if (gain(first, gone) > kNoGain * seconds(gone)) return first;
  return *std::ranges::max_element(left, {}, [&](Wall wall) { return alone(wall); });
}

Explanation Explainer::explain() {
  Explanation found{seconds({}), {}, {}, 0};
  const std::optional<Wall> first = binding({});
  if (!first) return found;
  for (const Wall wall : there_.list()) {
    const FoundWall one{wall, alone(wall), seconds({wall})};
    const bool takes_time = std::max(one.alone, found.seconds - one.without) > kNothing * found.seconds;
    if (wall == *first || takes_time) found.walls.push_back(one);
  }
  std::ranges::stable_sort(found.walls, std::greater<>(),
                           [&](const FoundWall& one) { return std::pair(one.wall == *first, gain(one.wall, {})); });
  const Walls gone{*first};
  found.next = binding(gone);
  if (found.next) found.without_next = seconds(gone.with({*found.next}));
  return found;
}

}  // namespace

std::vector<Wall> Walls::list() const {
  std::vector<Wall> walls;
  for (std::size_t i = 0; i < bits_.size(); ++i)
    if (bits_[i]) walls.push_back(static_cast<Wall>(i));
  return walls;
}

Explanation explain(const SecondsWithout& seconds, Walls there) { return Explainer(seconds, there).explain(); }

}  // namespace mars::walls
