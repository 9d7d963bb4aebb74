#include "host/content/modeler/skin_weights.h"

#include <algorithm>
#include <cmath>

namespace mars::modeler {
namespace {

// Leaves each bone once.
void add_up_same(std::vector<BoneWeight>& bones) {
  std::ranges::stable_sort(bones, {}, &BoneWeight::bone);
  std::size_t last = 0;
  for (std::size_t i = 1; i < bones.size(); ++i)
    if (bones[i].bone == bones[last].bone)
      bones[last].weight += bones[i].weight;
    else
      bones[++last] = bones[i];
  bones.resize(last + 1);
}

}  // namespace

std::optional<VertexBones> bones_of_vertex(std::vector<BoneWeight> bones) {
  std::erase_if(bones, [](const BoneWeight& each) { return !(each.weight > 0) || !std::isfinite(each.weight); });
  if (bones.empty()) return std::nullopt;
  add_up_same(bones);
  // Of equal ones, those with lower numbers.
  std::ranges::sort(bones, [](const BoneWeight& a, const BoneWeight& b) {
    return a.weight != b.weight ? a.weight > b.weight : a.bone < b.bone;
  });
  bones.resize(std::min(bones.size(), kMostBonesOfVertex));
  std::ranges::sort(bones, {}, &BoneWeight::bone);
  double sum = 0;
  for (const BoneWeight& each : bones) sum += each.weight;
  VertexBones out;
  for (std::size_t i = 0, at = 0; i < bones.size(); ++i) {
    const auto share = static_cast<float>(bones[i].weight / sum);
    if (share == 0) continue;
    out.bone[at] = bones[i].bone;
    out.weight[at++] = share;
  }
  return out;
}

std::vector<std::uint32_t> all_bones(std::span<const VertexBones> points) {
  std::vector<std::uint32_t> bones;
  for (const VertexBones& point : points)
    for (std::size_t i = 0; i < kMostBonesOfVertex; ++i)
      if (point.weight[i] > 0) bones.push_back(point.bone[i]);
  std::ranges::sort(bones);
  const auto again = std::ranges::unique(bones);
  bones.erase(again.begin(), again.end());
  return bones;
}

float weight_of(const VertexBones& point, std::uint32_t bone) {
  for (std::size_t i = 0; i < kMostBonesOfVertex; ++i)
    if (point.weight[i] > 0 && point.bone[i] == bone) return point.weight[i];
  return 0;
}

wire::Skin SkinLists::add(std::span<const VertexBones> points) {
  const wire::Skin skin = add_bones(all_bones(points));
  for (const std::uint32_t bone : std::span(bones).last(skin.bone_count))
    for (const VertexBones& point : points) weights.push_back(weight_of(point, bone));
  return skin;
}

wire::Skin SkinLists::add_bones(std::span<const std::uint32_t> all) {
  const wire::Skin skin{static_cast<std::uint32_t>(bones.size()), static_cast<std::uint32_t>(all.size()),
                        static_cast<std::uint32_t>(weights.size())};
  bones.insert(bones.end(), all.begin(), all.end());
  return skin;
}

}  // namespace mars::modeler
