// The man of the demo film walks as people do: a foot on the floor stays where it is, none goes through the
// floor, and one at least is always down. Measured on the shoes' surfaces in the compiled film.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <glm/geometric.hpp>
#include <optional>
#include <string>
#include <vector>

#include "host/content/film/compile.h"
#include "host/content/modeler/bent_skin.h"
#include "host/content/modeler/read_model.h"
#include "tests/host/content/modeler/surface.h"

namespace mars::film {
namespace {

constexpr double kMillimetre = 2.9 / 1000;  // the demo's metre is 2.9 units long: its man, 1.75 m
constexpr double kDown = 3 * kMillimetre;   // what is lower is on the floor

constexpr const char* kShoe[] = {"-foot", "-sole"};

class Walk : public ::testing::Test {
 protected:
  // Places, in the world, of points all over one shoe.
  std::vector<glm::dvec3> shoe(const std::string& side, std::uint32_t frame) const {
    std::vector<glm::dvec3> points;
    for (const wire::Segment& segment : film_.view().segments())
      for (const std::string part : kShoe)
        if (film_.view().name(segment) == "man/" + side + part) {
          for (const wire::Patch& patch : bent(segment, side + part, frame))
            for (const double u : {0.0, 0.5})
              for (const double v : {0.0, 0.5}) points.push_back(modeler::point_of(patch, u, v));
        }
    return points;
  }

  // The patches of the segment of a joint of the man.
  std::vector<wire::Patch> bent(const wire::Segment& segment, const std::string& name, std::uint32_t frame) const {
    std::vector<wire::Matrix> bones;
    for (const auto& bone : film_.view().bones_of(segment)) bones.push_back(film_.view().matrix_at(bone, frame));
    const auto joint = std::ranges::find(man_.joints, name, &modeler::Joint::name);
    return modeler::BentSkin(bones, joint->segment->blend).patches_of(*man_.shapes[joint->segment->shape].net);
  }

  std::uint32_t frames() const { return film_.view().settings().frames; }

  std::filesystem::path examples_ = std::filesystem::path(MARS_SOURCE_DIR) / "examples";
  CompiledFilm film_ = load_film(examples_ / "demo.json");
  modeler::Model man_ = modeler::load_model(examples_ / "models/human.json");
};

double lowest(const std::vector<glm::dvec3>& points) {
  double least = 1e9;
  for (const glm::dvec3& point : points) least = std::min(least, point.z);
  return least;
}

TEST_F(Walk, FeetOnTheFloorStayInPlace) {
  double most = 0;
  for (const std::string side : {"left", "right"}) {
    std::vector<std::optional<glm::dvec3>> landed(shoe(side, 0).size());
    std::size_t held = 0;
    for (std::uint32_t frame = 0; frame < frames(); ++frame) {
      const auto points = shoe(side, frame);
      for (std::size_t i = 0; i < points.size(); ++i) {
        if (points[i].z > kDown)
          landed[i].reset();
        else if (!landed[i])
          landed[i] = points[i];
        else {
          const double slid = std::hypot(points[i].x - landed[i]->x, points[i].y - landed[i]->y);
          most = std::max(most, slid);
          EXPECT_LT(slid, 3 * kMillimetre) << side << " foot, frame " << frame;
          ++held;
        }
      }
    }
    EXPECT_GT(held, 1500u) << "points that were measured";
  }
  RecordProperty("most_millimetres", std::to_string(most / kMillimetre));
}

TEST_F(Walk, OneFootAtLeastIsDownAndNoneThroughTheFloor) {
  for (std::uint32_t frame = 0; frame < frames(); ++frame) {
    const double left = lowest(shoe("left", frame)), right = lowest(shoe("right", frame));
    EXPECT_GT(std::min(left, right), -3 * kMillimetre) << "frame " << frame;
    EXPECT_LT(std::min(left, right), kDown) << "frame " << frame;
  }
}

TEST_F(Walk, BothFeetTakeStepsForward) {
  const auto middle = [&](const std::string& side, std::uint32_t frame) {
    glm::dvec3 sum(0, 0, 0);
    const auto points = shoe(side, frame);
    for (const glm::dvec3& point : points) sum += point;
    return sum / static_cast<double>(points.size());
  };
  for (const std::string side : {"left", "right"})
    EXPECT_GT(glm::distance(middle(side, 0), middle(side, frames() - 1)), 2500 * kMillimetre) << side;
}

}  // namespace
}  // namespace mars::film
