#include "host/content/modeler/read_skin_weights.h"

#include <algorithm>
#include <string>
#include <utility>

namespace mars::modeler {

VertexBones read_vertex_bones(const document::Element& element) {
  document::require_kind(element, document::Kind::list);
  if (element.size() % 2 == 1 || element.size() < 2 || element.size() > 2 * kMostBonesOfVertex)
    element.refuse("has " + std::to_string(element.size()) + " numbers", "write 1 to 4 pairs: [bone, weight, ...]");
  std::vector<BoneWeight> bones;
  for (auto item = element.begin(); item != element.end(); ++item) {
    const std::uint32_t bone = document::read_count(*item, 0, kMostBones - 1);
    if (std::ranges::any_of(bones, [&](const BoneWeight& other) { return other.bone == bone; }))
      element.refuse("names bone " + std::to_string(bone) + " twice", "add its weights up");
    bones.push_back({bone, document::read_number(*++item, {0, 1e6})});
  }
  const auto read = bones_of_vertex(std::move(bones));
  if (!read) element.refuse("has no weight", "let each vertex follow a bone");
  return *read;
}

}  // namespace mars::modeler
