#include "host/content/modeler/control_net.h"

#include <algorithm>
#include <functional>
#include <map>
#include <utility>

namespace mars::modeler {
namespace {

constexpr double kNothing = 1e-9;  // what weighs less leaves a mean

bool is_ascending(std::span<const Term> terms) {
  return std::ranges::adjacent_find(terms, std::ranges::greater_equal(), &Term::point) == terms.end();
}

// Leaves each point once.
std::vector<Term> merged(std::vector<Term> terms) {
  if (is_ascending(terms)) return terms;
  std::ranges::stable_sort(terms, {}, &Term::point);
  std::vector<Term> sum;
  for (const Term& term : terms) {
    if (sum.empty() || sum.back().point != term.point)
      sum.push_back(term);
    else
      sum.back().weight += term.weight;
  }
  return sum;
}

// Puts the sum of the terms and of a share, both ascending, into `sum`.
void add_share(std::span<const Term> terms, const Share& share, std::vector<Term>& sum) {
  sum.clear();
  sum.reserve(terms.size() + share.mean.size());
  auto own = terms.begin();
  for (const Term& term : share.mean) {
    while (own != terms.end() && own->point < term.point) sum.push_back(*own++);
    double weight = share.weight * term.weight;
    if (own != terms.end() && own->point == term.point) weight += (own++)->weight;
    sum.push_back({term.point, weight});
  }
  sum.insert(sum.end(), own, terms.end());
}

// Leaves what weighs enough, which then weighs 1; `sum` is ascending.
Mean normalized(Mean sum) {
  double all = 0;
  std::erase_if(sum, [](const Term& term) { return term.weight < kNothing; });
  for (const Term& term : sum) all += term.weight;
  for (Term& term : sum) term.weight /= all;
  return sum;
}

std::array<float, 3> rounded(const glm::dvec3& point) {
  return {static_cast<float>(point.x), static_cast<float>(point.y), static_cast<float>(point.z)};
}

wire::Patch rounded_patch(std::span<const glm::dvec3> points, const wire::PatchStencils& numbers) {
  wire::Patch patch;
  for (std::size_t i = 0; i < numbers.size(); ++i) patch.points[i] = rounded(points[numbers[i]]);
  return patch;
}

// Of each point the first that is the same.
std::vector<std::uint32_t> first_of_same(const ControlNet& net) {
  std::map<std::pair<std::array<float, 3>, VertexBones>, std::uint32_t> known;
  std::vector<std::uint32_t> first;
  for (std::uint32_t i = 0; i < net.points.size(); ++i)
    first.push_back(known.try_emplace({net.points[i], net.bones[i]}, i).first->second);
  return first;
}

}  // namespace

std::vector<Term> terms_of(std::span<const Share> shares) {
  std::vector<Term> terms, sum;
  for (const Share& share : shares) {
    add_share(terms, share, sum);
    terms.swap(sum);
  }
  return terms;
}

Mean sum_of(std::span<const Share> shares) { return normalized(terms_of(shares)); }

std::vector<wire::Patch> patches_of(const MeanPatches& means, std::span<const glm::dvec3> points) {
  std::vector<glm::dvec3> places;
  for (const Mean& mean : means.means) {
    glm::dvec3& place = places.emplace_back(0, 0, 0);
    for (const Term& term : mean) place += term.weight * points[term.point];
  }
  std::vector<wire::Patch> patches;
  for (const wire::PatchStencils& numbers : means.patches) patches.push_back(rounded_patch(places, numbers));
  return patches;
}

ControlNet control_net(const MeanPatches& means, std::span<const glm::dvec3> points, std::vector<VertexBones> bones,
                       std::size_t columns) {
  ControlNet net{{}, std::move(bones), columns, {}, {}, means.patches};
  for (const glm::dvec3& point : points) net.points.push_back(rounded(point));
  const std::vector<std::uint32_t> first = first_of_same(net);
  for (Mean mean : means.means) {
    for (Term& term : mean) term.point = first[term.point];
    mean = normalized(merged(std::move(mean)));
    net.stencils.push_back({static_cast<std::uint32_t>(net.terms.size()), static_cast<std::uint32_t>(mean.size())});
    for (const Term& term : mean) net.terms.push_back({term.point, static_cast<float>(term.weight)});
  }
  return net;
}

std::vector<glm::dvec3> means_of(const ControlNet& net, std::span<const glm::dvec3> moved) {
  std::vector<glm::dvec3> means;
  means.reserve(net.stencils.size());
  for (const wire::Stencil& stencil : net.stencils) {
    glm::dvec3 mean(0, 0, 0);
    for (const wire::StencilTerm& term : net.terms_of(stencil)) mean += double{term.weight} * moved[term.point];
    means.push_back(mean);
  }
  return means;
}

std::vector<wire::Patch> patches_of(const ControlNet& net, std::span<const glm::dvec3> moved) {
  const std::vector<glm::dvec3> means = means_of(net, moved);
  std::vector<wire::Patch> patches;
  for (const wire::PatchStencils& numbers : net.patches) patches.push_back(rounded_patch(means, numbers));
  return patches;
}

}  // namespace mars::modeler
