// Every shape of the library, as it is by default and at both ends of its option.
#include "host/content/modeler/shape_library.h"

#include <gtest/gtest.h>

#include <numeric>
#include <ostream>
#include <set>

#include "node/shape/dice.h"
#include "node/simd/instruction_set.h"
#include "tests/host/content/modeler/surface.h"

namespace mars::modeler {
namespace {

using Patches = std::vector<wire::Patch>;

struct Variant {
  const LibraryShape* shape;
  OptionValues values;
  std::string label{};

  Patches patches() const { return shape->make(values); }
};

std::vector<Variant> variants() {
  std::vector<Variant> all;
  for (const LibraryShape& shape : shape_library()) {
    const std::string name(shape.name);
    const keys::Key* const option = shape.option;
    const auto add = [&](double value, const std::string& label) {
      OptionValues values{};
      std::fill_n(values.begin(), option == nullptr ? 0 : keys::count_of(*option), value);
      all.push_back({&shape, values, label});
    };
    add(option == nullptr ? 0 : *option->number, name);
    if (option == nullptr) continue;
    add(option->range.lowest, name + "_least_" + std::string(option->name));
    add(option->range.highest, name + "_most_" + std::string(option->name));
  }
  const LibraryShape* box = find_library_shape("rounded_box");
  all.push_back({box, {0.5, 0.001, 0.2}, "rounded_box_uneven_edge"});
  all.push_back({box, {0.5, 0.5, 0.1}, "rounded_box_round_edge"});
  return all;
}

void PrintTo(const Variant& variant, std::ostream* out) { *out << variant.label; }

class Library : public testing::TestWithParam<Variant> {
 protected:
  bool is(std::initializer_list<std::string_view> names) const {
    return std::find(names.begin(), names.end(), GetParam().shape->name) != names.end();
  }

  const Patches patches_ = GetParam().patches();
};

INSTANTIATE_TEST_SUITE_P(Shapes, Library, testing::ValuesIn(variants()),
                         [](const auto& info) { return info.param.label; });

// Patches that hang together by their corners: a hand is a palm and five fingers.
std::vector<Patches> pieces_of(const Patches& patches) {
  std::vector<std::size_t> group(patches.size());
  std::iota(group.begin(), group.end(), 0);
  const auto root = [&](std::size_t i) {
    while (group[i] != i) i = group[i];
    return i;
  };
  std::map<Point, std::size_t> owner;
  for (std::size_t i = 0; i < patches.size(); ++i)
    for (const std::size_t corner : {0, 3, 12, 15})
      group[root(i)] = root(owner.try_emplace(patches[i].points[corner], i).first->second);
  std::map<std::size_t, Patches> pieces;
  for (std::size_t i = 0; i < patches.size(); ++i) pieces[root(i)].push_back(patches[i]);
  std::vector<Patches> result;
  for (auto& [first, piece] : pieces) result.push_back(std::move(piece));
  return result;
}

TEST_P(Library, FillsTheUnitCube) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    float least = 1, greatest = 0;
    for (const wire::Patch& patch : patches_)
      for (const auto& point : patch.points) {
        least = std::min(least, point[axis]);
        greatest = std::max(greatest, point[axis]);
      }
    EXPECT_EQ(least, 0.0f);
    EXPECT_EQ(greatest, 1.0f);
  }
}

TEST_P(Library, IsClosedBitForBit) {
  if (is({"teapot"})) return;  // Newell's is open; primitives_test says where
  for (const auto& [edge, use] : edge_uses(patches_)) {
    EXPECT_EQ(use.forward, 1);
    EXPECT_EQ(use.backward, 1);
  }
}

// With closedness, which lets neighbours have the same outside only, and normals that agree with the diced
// faces: the outside of all patches is outside.
TEST_P(Library, IsMadeOfPiecesWithTheirOutsideOut) {
  if (is({"teapot"})) return;
  const auto pieces = pieces_of(patches_);
  EXPECT_EQ(pieces.size(), is({"left_hand", "right_hand"}) ? 6u : is({"head"}) ? 3u : is({"hand"}) ? 2u : 1u);
  for (const Patches& piece : pieces) EXPECT_GT(volume_of(piece, 6), 0.0004);
}

glm::dvec3 vector_of(float* const columns[3], std::uint32_t vertex) {
  return {columns[0][vertex], columns[1][vertex], columns[2][vertex]};
}

// The sbb in which what is rounded by an option is round.
glm::dvec3 round_box(const Variant& variant) {
  const std::string_view option = variant.shape->option == nullptr ? "" : variant.shape->option->name;
  const double value = variant.values[0];
  if (option == "ends") return {1, 1, 0.5 / value};
  if (option == "rim" || option == "tube") return {1, 1, 2 * value};
  if (option == "edge") return {1 / value, 1 / variant.values[1], 1 / variant.values[2]};
  return {1, 1, 1};
}

// As nodes draw it, poles and other collapsed edges included.
TEST_P(Library, HasUnitNormalsOnTheOutsideOfEveryDicedFace) {
  const glm::dvec3 box = round_box(GetParam());
  const glm::vec3 size = box / std::max({box.x, box.y, box.z});
  const shape::EyeMatrix away{{{size.x, 0, 0, 0}, {0, size.y, 0, 0}, {0, 0, size.z, -2}}};
  const shape::Projection view{1000, {500, 500}, 0.1f, 100, 8000, 0.5f};
  shape::Dicer dicer(simd::best_instruction_set(""));
  for (const wire::Patch& patch : patches_) {
    dicer.dice(shape::to_eye(away, patch), view, {.fixed_rate = 8, .tolerances = {}});
    for (std::uint32_t number = 0; number < dicer.triangles().count; ++number) {
      const auto [a, b, c] = dicer.triangles()[number];
      const auto place = [&](std::uint32_t vertex) { return vector_of(dicer.vertices().place, vertex); };
      const glm::dvec3 ab = place(b) - place(a), ac = place(c) - place(a), face = glm::cross(ab, ac);
      const bool at_a_point = std::min({glm::length(ab), glm::length(ac), glm::length(ab - ac)}) < 2e-6;
      for (const std::uint32_t vertex : {a, b, c}) {
        const glm::dvec3 normal = vector_of(dicer.vertices().normal, vertex);
        ASSERT_NEAR(glm::length(normal), 1, 1e-5);
        if (at_a_point) continue;  // a face without extent, its corners apart by rounding
        ASSERT_GT(glm::dot(normal, glm::normalize(face)), is({"teapot"}) ? 0.4 : 0.8);
      }
    }
  }
}

// The unit normals on both patches of every shared side, at three places of it.
TEST_P(Library, IsSmoothAcrossItsEdges) {
  if (is({"box", "cylinder", "cone", "teapot"})) return;
  constexpr double ends[4][4] = {{0, 0, 1, 0}, {1, 0, 1, 1}, {1, 1, 0, 1}, {0, 1, 0, 0}};  // u, v as sides_of runs
  std::map<std::pair<Edge, int>, glm::dvec3> seen;
  for (const wire::Patch& patch : patches_) {
    const auto sides = sides_of(patch);
    for (std::size_t side = 0; side < 4; ++side)
      for (const int step : {1, 2, 3}) {
        if (collapsed(sides[side])) continue;
        const Edge back{sides[side][3], sides[side][2], sides[side][1], sides[side][0]};
        const double t = step / 4.0, u = ends[side][0] + t * (ends[side][2] - ends[side][0]),
                     v = ends[side][1] + t * (ends[side][3] - ends[side][1]);
        const glm::dvec3 normal = glm::normalize(normal_of(patch, u, v));
        const auto other = seen.find({back, 4 - step});
        if (other == seen.end()) {
          seen[{sides[side], step}] = normal;
        } else {
          EXPECT_GT(glm::dot(normal, other->second), 0.9995);
        }
      }
  }
}

TEST(ShapeLibrary, NamesEveryShapeOnce) {
  std::set<std::string_view> names;
  for (const LibraryShape& shape : shape_library()) {
    EXPECT_TRUE(names.insert(shape.name).second) << shape.name;
    EXPECT_EQ(find_library_shape(shape.name), &shape);
    EXPECT_FALSE(shape.what.empty()) << shape.name;
  }
  EXPECT_EQ(find_library_shape("sail"), nullptr);
}

TEST(ShapeLibrary, KnowsWhatAWrongNameMayMean) {
  const std::string_view own[] = {"sail"};
  EXPECT_EQ(likely_shape("capsul"), "did you mean 'capsule'?");
  EXPECT_EQ(likely_shape("sial", own), "did you mean 'sail'?");
  EXPECT_NE(likely_shape("xyzxyz").find("define it"), std::string::npos);
}

}  // namespace
}  // namespace mars::modeler
