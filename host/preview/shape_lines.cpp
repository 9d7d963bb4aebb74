#include "host/preview/shape_lines.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <map>
#include <unordered_map>
#include <unordered_set>

namespace mars::preview {
namespace {

using Point = std::array<float, 3>;

struct PointHash {
  std::size_t operator()(const Point& point) const {
    std::size_t hash = 0;
    for (const float coordinate : point) hash = (hash ^ std::hash<float>()(coordinate)) * 0x9e3779b97f4a7c15u;
    return hash ^ hash >> 32;
  }
};

void add_point(Lines& lines, const glm::dvec3& point) {
  for (int axis = 0; axis < 3; ++axis) lines.points.push_back(static_cast<float>(point[axis]));
}

class Net {
 public:
  void add(const wire::Patch& patch) { join_net(numbers_of(patch.points)); }

  // Of the skin whose net is set().
  void add(const wire::Patch& patch, const wire::PatchStencils& means) {
    const std::vector<std::uint32_t> numbers = numbers_of(patch.points);
    for (std::size_t point = 0; point < numbers.size(); ++point)
      if (numbers[point] == lines_.means.size()) lines_.means.push_back(means[point]);
    join_net(numbers);
  }
  void set(modeler::ControlNet net) { lines_.net = std::move(net); }

  void add(std::span<const Point> vertices, std::span<const wire::MeshTriangle> triangles,
           std::span<const modeler::VertexBones> follows) {
    const std::vector<std::uint32_t> numbers = numbers_of(vertices);
    for (std::size_t point = 0; point < follows.size(); ++point)
      if (numbers[point] == lines_.means.size() + lines_.bones.size()) lines_.bones.push_back(follows[point]);
    for (const wire::MeshTriangle& corners : triangles)
      for (std::size_t i = 0; i < 3; ++i) join(numbers[corners[i]], numbers[corners[(i + 1) % 3]]);
  }

  Lines take() {
    lines_.dots = static_cast<std::uint32_t>(points_.size());
    return std::move(lines_);
  }

 private:
  std::vector<std::uint32_t> numbers_of(std::span<const Point> points) {
    std::vector<std::uint32_t> numbers;
    for (const Point& point : points) numbers.push_back(number_of(point));
    return numbers;
  }

  void join_net(std::span<const std::uint32_t> numbers) {
    for (std::size_t row = 0; row < 4; ++row)
      for (std::size_t column = 0; column < 3; ++column) {
        join(numbers[4 * row + column], numbers[4 * row + column + 1]);
        join(numbers[4 * column + row], numbers[4 * (column + 1) + row]);
      }
  }

  std::uint32_t number_of(const Point& point) {
    const auto [known, is_new] = points_.try_emplace(point, static_cast<std::uint32_t>(points_.size()));
    if (is_new) lines_.points.insert(lines_.points.end(), point.begin(), point.end());
    return known->second;
  }

  void join(std::uint32_t a, std::uint32_t b) {
    if (a == b) return;
    const std::uint64_t both = std::uint64_t{std::min(a, b)} << 32 | std::max(a, b);
    if (joined_.insert(both).second) lines_.ends.insert(lines_.ends.end(), {a, b});
  }

  Lines lines_;
  std::unordered_map<Point, std::uint32_t, PointHash> points_;
  std::unordered_set<std::uint64_t> joined_;
};

// What each of the points follows; none where they have no skin.
std::vector<modeler::VertexBones> followed_by(const wire::PackedFilm& film, const wire::Skin& skin,
                                              std::uint32_t points) {
  std::vector<modeler::VertexBones> all;
  for (std::size_t point = 0; point < points && skin.bone_count > 0; ++point) {
    std::vector<modeler::BoneWeight> bones;
    std::size_t at = skin.first_weight + point;
    for (const std::uint32_t bone : film.bones_of(skin)) {
      bones.push_back({bone, film.skin_weights()[at]});
      at += points;
    }
    all.push_back(*modeler::bones_of_vertex(std::move(bones)));
  }
  return all;
}

// Gives numbers in the order in which they are first asked for.
class Numbers {
 public:
  std::uint32_t of(std::uint32_t number) {
    const auto [known, is_new] = known_.try_emplace(number, static_cast<std::uint32_t>(all_.size()));
    if (is_new) all_.push_back(number);
    return known->second;
  }
  std::span<const std::uint32_t> all() const { return all_; }

 private:
  std::unordered_map<std::uint32_t, std::uint32_t> known_;
  std::vector<std::uint32_t> all_;
};

// How the patches of a shape with a skin bend, by numbers of its own; none of other shapes.
modeler::ControlNet bent_net(const wire::PackedFilm& film, const wire::Shape& shape) {
  modeler::ControlNet net;
  Numbers stencils, points;
  for (const wire::NetPatch& patch : film.net_patches_of(shape)) {
    wire::PatchStencils& own = net.patches.emplace_back(patch.stencils);
    for (std::uint32_t& stencil : own) stencil = stencils.of(stencil);
  }
  for (const std::uint32_t number : stencils.all()) {
    const auto terms = film.terms_of(film.stencils()[number]);
    net.stencils.push_back({static_cast<std::uint32_t>(net.terms.size()), static_cast<std::uint32_t>(terms.size())});
    for (const wire::StencilTerm& term : terms) net.terms.push_back({points.of(term.point), term.weight});
  }
  for (const std::uint32_t number : points.all()) {
    const wire::NetPoint& point = film.net_points()[number];
    net.points.push_back(point.place);
    net.bones.push_back(followed_by(film, point.skin, 1).front());
  }
  return net;
}

void add_prism(Lines& lines, const modeler::Box& box) {
  const auto first = static_cast<std::uint32_t>(lines.points.size() / 3);
  for (std::uint32_t corner = 0; corner < 8; ++corner) {
    add_point(lines, glm::mix(box.min, box.max, glm::dvec3(corner & 1, corner >> 1 & 1, corner >> 2)));
    for (const std::uint32_t axis : {1u, 2u, 4u})
      if ((corner & axis) == 0) lines.ends.insert(lines.ends.end(), {first + corner, first + (corner | axis)});
  }
}

// The middle of the box's face that is farthest from the joint, in the unit cube.
glm::dvec3 far_end(const modeler::Box& sbb) {
  glm::dvec3 end(0.5);
  double farthest = -1;
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {sbb.min[axis], sbb.max[axis]})
      if (std::abs(side) > farthest) {
        farthest = std::abs(side);
        end = glm::dvec3(0.5);
        end[axis] = side == sbb.min[axis] ? 0 : 1;
      }
  return end;
}

// A place in the joint's frame, in the unit cube of its segment if it has one.
glm::dvec3 in_own(const modeler::Joint& joint, const glm::dvec3& place) {
  if (!joint.segment) return place;
  const glm::dmat3 axes(joint.x_axis, joint.y_axis, glm::cross(joint.x_axis, joint.y_axis));
  const modeler::Box& sbb = joint.segment->sbb;
  return (glm::inverse(axes) * place - sbb.min) / (sbb.max - sbb.min);
}

// From the first point.
void add_stick(Lines& lines, const glm::dvec3& end) {
  lines.ends.insert(lines.ends.end(), {0, static_cast<std::uint32_t>(lines.points.size() / 3)});
  add_point(lines, end);
}

}  // namespace

Lines control_net(const wire::PackedFilm& film, const wire::Shape& shape) {
  Net net;
  const auto patches = film.patches().subspan(shape.first_patch, shape.patch_count);
  modeler::ControlNet bent = bent_net(film, shape);
  for (std::size_t i = 0; i < patches.size(); ++i)
    bent.patches.empty() ? net.add(patches[i]) : net.add(patches[i], bent.patches[i]);
  net.set(std::move(bent));
  for (const wire::Meshlet& meshlet : film.meshlets().subspan(shape.first_meshlet, shape.meshlet_count))
    net.add(film.mesh_places().subspan(meshlet.first_vertex, meshlet.vertex_count),
            film.mesh_triangles().subspan(meshlet.first_triangle, meshlet.triangle_count),
            followed_by(film, meshlet.skin, meshlet.vertex_count));
  return net.take();
}

Lines control_net(std::span<const wire::Patch> patches) {
  Net net;
  for (const wire::Patch& patch : patches) net.add(patch);
  return net.take();
}

Lines cube_edges() {
  Lines lines;
  add_prism(lines, {});
  return lines;
}

Lines bone_prisms(const wire::PackedFilm& film, const wire::Shape& shape) {
  std::map<std::uint32_t, modeler::Box> boxes;
  const auto grow = [&](const Point& point, const modeler::VertexBones& follows) {
    const auto heaviest = std::ranges::max_element(follows.weight) - std::begin(follows.weight);
    const glm::dvec3 place(point[0], point[1], point[2]);
    modeler::Box& box =
        boxes.try_emplace(follows.bone[std::size_t(heaviest)], modeler::Box{place, place}).first->second;
    box = {glm::min(box.min, place), glm::max(box.max, place)};
  };
  const modeler::ControlNet net = bent_net(film, shape);
  for (std::size_t point = 0; point < net.points.size(); ++point) grow(net.points[point], net.bones[point]);
  for (const wire::Meshlet& meshlet : film.meshlets().subspan(shape.first_meshlet, shape.meshlet_count)) {
    const auto follows = followed_by(film, meshlet.skin, meshlet.vertex_count);
    for (std::size_t vertex = 0; vertex < follows.size(); ++vertex)
      grow(film.mesh_places()[meshlet.first_vertex + vertex], follows[vertex]);
  }
  Lines lines;
  for (const auto& [bone, box] : boxes) {
    add_prism(lines, box);
    lines.bones.resize(lines.points.size() / 3, {{bone}, {1}});
  }
  return lines;
}

Lines cube_axis(int axis) {
  Lines lines;
  for (const double side : {0.0, 1.0}) {
    glm::dvec3 point(0.5);
    point[axis] = side;
    add_point(lines, point);
  }
  lines.ends = {0, 1};
  lines.dots = 1;
  return lines;
}

std::vector<Lines> sticks_of(const modeler::Model& model) {
  std::vector<Lines> sticks(model.joints.size());
  for (std::size_t number = 0; number < model.joints.size(); ++number) {
    const modeler::Joint& joint = model.joints[number];
    add_point(sticks[number], in_own(joint, {0, 0, 0}));
    sticks[number].dots = 1;
    if (joint.parent != modeler::kNone)
      add_stick(sticks[joint.parent], in_own(model.joints[joint.parent], joint.place));
  }
  for (std::size_t number = 0; number < model.joints.size(); ++number)
    if (const auto& segment = model.joints[number].segment;
        segment && segment->bones.empty() && sticks[number].ends.empty())
      add_stick(sticks[number], far_end(segment->sbb));
  return sticks;
}

}  // namespace mars::preview
