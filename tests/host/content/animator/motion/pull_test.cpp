// What a hand pulls comes along: to the place, within limits, with what is pinned where it was, without a jump.
#include "host/content/animator/motion/body/pull.h"

#include <gtest/gtest.h>

#include <ctime>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "host/content/animator/motion/body/body.h"
#include "tests/host/content/animator/motion/bodies.h"
#include "tests/sanitizers/sanitized.h"

namespace mars::motion {
namespace {

using modeler::Limb;
using modeler::Side;
using modeler::Trunk;

class Pulled {
 public:
  explicit Pulled(const document::Json& figure) : film_(read(film_with(figure))) {
    rest = posture = posture_at(model(), film_.actors[0].motion, 0);
  }

  const modeler::Model& model() const { return film_.models[0]; }
  std::size_t of(Limb limb, Side side) const { return model().limbs.of(limb, side); }
  std::size_t of(Trunk part) const { return model().limbs.of(part); }
  modeler::Axes frame(std::size_t joint) const { return frame_in(model(), posture, joint); }
  modeler::Axes rest_frame(std::size_t joint) const { return frame_in(model(), rest, joint); }

  double to(const Chain& chain, const glm::dvec3& place, std::span<const std::size_t> pins = {}) {
    const double left = pull(model(), rest, posture, chain, {.to = place}, pins);
    EXPECT_NEAR(left, glm::distance(frame(chain.end).place, place), 1e-12);
    for (std::size_t i = 0; i < posture.pose.size(); ++i)
      for (int axis = 0; axis < 3; ++axis) {
        EXPECT_GE(posture.pose[i][axis], model().joints[i].limits[axis].lower) << model().joints[i].name;
        EXPECT_LE(posture.pose[i][axis], model().joints[i].limits[axis].upper) << model().joints[i].name;
      }
    return left;
  }

  Posture rest, posture;

 private:
  animator::Film film_;
};

constexpr double kLeg = 2.42, kArm = 1.62;

TEST(Chain, IsTheLimbOfTheTable) {
  const Pulled man(human());
  const auto names = [&](const std::vector<std::size_t>& joints) {
    std::string all;
    for (const std::size_t joint : joints) all += man.model().joints[joint].name + " ";
    return all;
  };
  const std::size_t hand = man.of(Limb::wrist, Side::left), toes = man.of(Limb::toes, Side::right);
  EXPECT_EQ(names(chain_of(man.model(), hand).joints), "left-upper-arm left-forearm left-hand ");
  EXPECT_EQ(names(chain_of(man.model(), hand, Extent::trunk).trunk), "spine chest left-clavicle ");
  EXPECT_EQ(names(chain_of(man.model(), hand, Extent::body).trunk), "pelvis spine chest left-clavicle ");
  EXPECT_TRUE(chain_of(man.model(), hand, Extent::body).moves_actor);
  EXPECT_EQ(names(chain_of(man.model(), toes).joints), "right-thigh right-shin right-foot ");
  EXPECT_EQ(names(chain_of(man.model(), man.of(Trunk::head)).joints), "spine chest neck head ");
  EXPECT_EQ(names(chain_of(man.model(), man.of(Limb::elbow, Side::right)).joints), "right-upper-arm right-forearm ");
  EXPECT_TRUE(chain_of(man.model(), man.of(Trunk::pelvis)).moves_actor);
}

TEST(Chain, WithoutLimbsEndsBelowABranch) {
  document::Json model = human();
  model.erase("limbs");
  const Pulled man(model);
  const auto hand = [&](const char* name) {
    for (std::size_t i = 0; i < man.model().joints.size(); ++i)
      if (man.model().joints[i].name == name) return i;
    return modeler::kNone;
  };
  const Chain chain = chain_of(man.model(), hand("left-hand"));
  EXPECT_EQ(chain.joints, (std::vector{hand("left-forearm"), hand("left-hand")}))
      << "the sleeve hangs on the upper arm";
}

TEST(Pull, BringsAHandWhereItShallBeAndBack) {
  Pulled man(human());
  const std::size_t hand = man.of(Limb::wrist, Side::right);
  const Chain chain = chain_of(man.model(), hand);
  const glm::dvec3 began = man.frame(hand).place;
  const glm::dvec3 forward = canonical_turn(0, 0, 30)[0];
  const glm::dvec3 shoulder = man.frame(chain.joints[0]).place;
  double before = 0;
  for (int i = 1; i <= 60; ++i) {
    const glm::dvec3 to = glm::mix(began, shoulder + 1.5 * forward, i / 60.0);
    EXPECT_LT(man.to(chain, to), 1e-4) << i;
  }
  for (int i = 60; i >= 0; --i) before = man.to(chain, glm::mix(began, shoulder + 1.5 * forward, i / 60.0));
  EXPECT_LT(before, 1e-4);
  for (std::size_t i = 0; i < man.posture.pose.size(); ++i)
    EXPECT_LT(glm::distance(man.posture.pose[i], man.rest.pose[i]), 0.5) << man.model().joints[i].name;
}

// Far beyond, along the limit of its reach, and back: never more than a hand that is dragged by hand.
TEST(Pull, DoesNotJumpAtFullStretch) {
  Pulled man(human());
  const std::size_t hand = man.of(Limb::wrist, Side::right), elbow = man.of(Limb::elbow, Side::right);
  for (const Extent extent : {Extent::limb, Extent::trunk, Extent::body}) {
    man.posture = man.rest;
    const Chain chain = chain_of(man.model(), hand, extent);
    const std::size_t pins[] = {man.of(Limb::ankle, Side::left), man.of(Limb::ankle, Side::right)};
    const glm::dvec3 began = man.frame(hand).place, forward = canonical_turn(0, 0, 10)[0];
    glm::dvec3 hand_was = began, elbow_was = man.frame(elbow).place;
    for (int i = 0; i <= 400; ++i) {
      const double part = i <= 200 ? i / 200.0 : 2 - i / 200.0;
      const glm::dvec3 to = began + part * 4.0 * forward + glm::dvec3(0, 0, 1.5 * part);
      man.to(chain, to, pins);
      const double step = 4.3 / 200;
      EXPECT_LT(glm::distance(man.frame(hand).place, hand_was), 3 * step) << int(extent) << " " << i;
      EXPECT_LT(glm::distance(man.frame(elbow).place, elbow_was), 8 * step) << int(extent) << " " << i;
      hand_was = man.frame(hand).place;
      elbow_was = man.frame(elbow).place;
    }
  }
}

TEST(Pull, BendsWhatIsStraight) {
  Pulled man(human());
  const std::size_t hand = man.of(Limb::wrist, Side::left), elbow = man.of(Limb::elbow, Side::left);
  man.rest.pose[elbow] = man.posture.pose[elbow] = {0, 0, 0};
  const Chain chain = chain_of(man.model(), hand);
  const glm::dvec3 shoulder = man.frame(chain.joints[0]).place;
  EXPECT_LT(man.to(chain, glm::mix(man.frame(hand).place, shoulder, 0.3)), 1e-4);
  EXPECT_LT(man.posture.pose[elbow].y, -20);
}

TEST(Pull, LeavesPinnedFeetWhereTheyStand) {
  for (const double size : {1.0, 0.6}) {
    Pulled man(built(size, 1, 1));
    const std::size_t pins[] = {man.of(Limb::ankle, Side::left), man.of(Limb::ankle, Side::right)};
    const std::size_t pelvis = man.of(Trunk::pelvis), hand = man.of(Limb::wrist, Side::right);
    const auto expect_feet = [&](double most) {
      for (const std::size_t foot : pins) {
        EXPECT_LT(glm::distance(man.frame(foot).place, man.rest_frame(foot).place), most * size);
        EXPECT_LT(glm::degrees(animator::turn_between(man.frame(foot).turn, man.rest_frame(foot).turn).angle), 0.05);
      }
    };
    const glm::dvec3 stood = man.frame(pelvis).place;
    const Chain down = chain_of(man.model(), pelvis);
    for (int i = 1; i <= 12; ++i) EXPECT_LT(man.to(down, stood - size * glm::dvec3(0, 0, i * 0.01), pins), 1e-3 * size);
    expect_feet(1e-4);
    EXPECT_GT(man.to(down, stood + size * glm::dvec3(0, 0, 1), pins), 0.9 * size);
    expect_feet(1e-3);
    man.posture = man.rest;
    const glm::dvec3 forward = canonical_turn(0, 0, 30)[0];
    const glm::dvec3 floor = man.rest_frame(pins[1]).place + size * (1.0 * forward);
    EXPECT_LT(man.to(chain_of(man.model(), hand, Extent::body), floor, pins), 1e-3 * size);
    expect_feet(1e-4);
  }
}

TEST(Pull, TurnsAFootAsItIsAsked) {
  Pulled man(human());
  const std::size_t foot = man.of(Limb::ankle, Side::left);
  const Chain chain = chain_of(man.model(), foot);
  const modeler::Axes frame = man.frame(foot);
  const glm::dvec3 to = frame.place + 0.4 * canonical_turn(0, 0, 30)[0] + glm::dvec3(0, 0, 0.5);
  EXPECT_LT(pull(man.model(), man.rest, man.posture, chain, {.to = to, .turn = frame.turn}, {}), 1e-3);
  EXPECT_LT(glm::degrees(animator::turn_between(man.frame(foot).turn, frame.turn).angle), 0.5);
}

TEST(Pull, LiftsAFootHighAtOnce) {
  Pulled man(human());
  const Chain chain = chain_of(man.model(), man.of(Limb::ankle, Side::left));
  const glm::dvec3 forward = canonical_turn(0, 0, 30)[0];
  EXPECT_LT(man.to(chain, man.frame(chain.end).place + 0.9 * forward + glm::dvec3(0, 0, 0.75)), 1e-3);
}

TEST(Pull, IsQuickEnoughForAMouse) {
  Pulled man(human());
  const std::size_t pins[] = {man.of(Limb::ankle, Side::left), man.of(Limb::ankle, Side::right)};
  const Chain chain = chain_of(man.model(), man.of(Limb::wrist, Side::right), Extent::body);
  const glm::dvec3 began = man.frame(chain.end).place, forward = canonical_turn(0, 0, 30)[0];
  constexpr int kMoves = 200;
  constexpr double kMost = 20 * sanitizers::kSlowness;  // milliseconds of processor time a move
  const std::clock_t start = std::clock();
  for (int i = 0; i < kMoves; ++i)
    pull(man.model(), man.rest, man.posture, chain, {.to = began + 0.02 * i * forward}, pins);
  const double took = 1000.0 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC / kMoves;
  RecordProperty("milliseconds", std::to_string(took));
  EXPECT_LT(took, kMost);
}

}  // namespace
}  // namespace mars::motion
