#include "host/render/walls/even.h"

#include <algorithm>
#include <cstddef>

namespace mars::walls {
namespace {

double part(double mean, double own) { return own > mean ? mean / own : 1; }

}  // namespace

std::vector<Pace> even_out(const std::vector<Busy>& busy, const std::vector<collectives::Group>& groups) {
  std::vector<Pace> paces(busy.size());
  std::vector<Busy> means;  // of a node, by group
  double all = 0;
  for (const collectives::Group& group : groups) {
    Busy& mean = means.emplace_back();
    for (int n = group.first; n < group.first + group.count; ++n) {
      mean.keyframes += busy[static_cast<std::size_t>(n)].keyframes / group.count;
      mean.inbetweens += busy[static_cast<std::size_t>(n)].inbetweens / group.count;
    }
    all += (mean.keyframes + mean.inbetweens) * group.count;
  }
  const double mean = all / static_cast<double>(busy.size());
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const double of_group = part(mean, means[g].keyframes + means[g].inbetweens);
    for (int n = groups[g].first; n < groups[g].first + groups[g].count; ++n) {
      const auto node = static_cast<std::size_t>(n);
      paces[node] = {of_group, of_group * part(means[g].inbetweens, busy[node].inbetweens)};
    }
  }
  return paces;
}

}  // namespace mars::walls
