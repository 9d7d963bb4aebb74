#include "host/render/walls/walls.h"

#include <algorithm>
#include <map>

namespace mars::walls {
namespace {

// A wall that takes less is none.
constexpr double kNothing = 1e-3;

// Work that is not evenly divided: parts of what work takes.
const Walls kUneven{Wall::imbalance, Wall::frame};

class Explainer {
 public:
  Explainer(const AllSecondsWithout& seconds, Walls there) : ask_(seconds), there_(there) {}

  Explanation explain();

 private:
  double seconds(Walls without) {
    if (!known_.contains(without.number())) ask({without});
    return known_.at(without.number());
  }
  void ask(const std::vector<Walls>& all);
  static Walls beside(Wall wall, Walls gone);
  static std::vector<Walls> asked_alone(Wall wall);
  double gain(Wall wall, Walls gone);
  double alone(Wall wall);
  std::optional<Wall> binding(Walls gone);

  const AllSecondsWithout& ask_;
  const Walls there_;
  std::map<unsigned long, double> known_;
};

// All at once: they may be found side by side.
void Explainer::ask(const std::vector<Walls>& all) {
  std::map<unsigned long, Walls> fresh;
  for (const Walls each : all)
    if (!known_.contains(each.number())) fresh.emplace(each.number(), each);
  std::vector<Walls> asked;
  for (const auto& [number, each] : fresh) asked.push_back(each);
  const std::vector<double> seconds = ask_(asked);
  for (std::size_t i = 0; i < asked.size(); ++i) known_.emplace(asked[i].number(), seconds[i]);
}

// Of work: beyond what walls gain that are part of it.
Walls Explainer::beside(Wall wall, Walls gone) { return wall == Wall::compute ? gone.with(kUneven) : gone; }

double Explainer::gain(Wall wall, Walls gone) {
  return seconds(beside(wall, gone)) - seconds(beside(wall, gone).with({wall}));
}

// What is uneven is work: beside evenly divided work.
std::vector<Walls> Explainer::asked_alone(Wall wall) {
  if (!kUneven.has(wall)) return {Walls::all().without({wall})};
  const Walls even = Walls::all().without({Wall::compute});
  return {even.without({wall}), even};
}

double Explainer::alone(Wall wall) {
  const std::vector<Walls> asked = asked_alone(wall);
  return asked.size() == 1 ? seconds(asked[0]) : seconds(asked[0]) - seconds(asked[1]);
}

std::optional<Wall> Explainer::binding(Walls gone) {
  const std::vector<Wall> left = there_.without(gone).list();
  if (left.empty()) return std::nullopt;
  std::vector<Walls> asked{gone};
  for (const Wall wall : left) {
    asked.push_back(beside(wall, gone));
    asked.push_back(beside(wall, gone).with({wall}));
    for (const Walls alone : asked_alone(wall)) asked.push_back(alone);
  }
  ask(asked);
  const Wall first = *std::ranges::max_element(left, {}, [&](Wall wall) { return gain(wall, gone); });
  if (gain(first, gone) > kNoGain * seconds(gone)) return first;
  return *std::ranges::max_element(left, {}, [&](Wall wall) { return alone(wall); });
}

Explanation Explainer::explain() {
  const std::optional<Wall> first = binding({});
  Explanation found{seconds({}), {}, {}, 0};
  if (!first) return found;
  for (const Wall wall : there_.list()) {
    const FoundWall one{wall, alone(wall), seconds({wall}), gain(wall, {})};
    const bool takes_time = std::max(one.alone, found.seconds - one.without) > kNothing * found.seconds;
    if (wall == *first || takes_time) found.walls.push_back(one);
  }
  std::ranges::stable_sort(found.walls, std::greater<>(),
                           [&](const FoundWall& one) { return std::pair(one.wall == *first, one.gain); });
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

Explanation explain(const AllSecondsWithout& seconds, Walls there) { return Explainer(seconds, there).explain(); }

Explanation explain(const SecondsWithout& seconds, Walls there) {
  const auto one_by_one = [&](const std::vector<Walls>& all) {
    std::vector<double> found;
    for (const Walls walls : all) found.push_back(seconds(walls));
    return found;
  };
  return explain(AllSecondsWithout(one_by_one), there);
}

}  // namespace mars::walls
