#include "topology/hypercube.h"

namespace mars::topology {

std::vector<int> route(int from, int to) {
  std::vector<int> nodes{from};
  while (nodes.back() != to) nodes.push_back(next_on_route(nodes.back(), to));
  return nodes;
}

std::vector<int> members(const SubCube& cube) {
  std::vector<int> nodes;
  for (int k = 0; k < cube.size(); ++k) nodes.push_back(cube.member(k));
  return nodes;
}

}  // namespace mars::topology
