// Feet on the floor stay where they are, none goes through it, one at least is down: for bodies of several
// builds, measured on the soles' surfaces in compiled films.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <string_view>

#include "host/content/animator/motion/body/body.h"
#include "host/content/animator/keys/reduce.h"
#include "host/content/film/compile.h"
#include "host/content/modeler/bent_skin.h"
#include "tests/host/content/animator/motion/bodies.h"
#include "tests/host/content/modeler/surface.h"

namespace mars::motion {
namespace {

// Of a leg's length, which is 835 mm on a man of 1.75 m: what is lower is on the floor; how far it may slide,
// and go through.
constexpr double kDown = 0.003, kSlide = 0.002, kThrough = 0.003;
// Straight legs under narrow hips leave the floor sideways.
constexpr double kNarrow = 0.04, kNarrowSlide = 0.05;

constexpr std::string_view kSoles[] = {"foot", "toes", "sole", "hoof", "paw"};

using Points = std::vector<glm::dvec3>;

// A film, compiled, and the model of anna in it.
struct FilmOfAnna {
  explicit FilmOfAnna(const animator::Film& film) : compiled(film::compile(film)), model(film.model_of(0)) {}

  film::CompiledFilm compiled;
  modeler::Model model;
};

// Of a segment that is rigid, or whose bones bend it, in the world.
std::vector<wire::Patch> patches_at(const FilmOfAnna& film, const wire::Segment& segment, const std::string& joint,
                                    std::uint32_t frame) {
  const wire::PackedFilm view = film.compiled.view();
  const auto named = std::ranges::find(film.model.joints, joint, &modeler::Joint::name);
  const modeler::Shape& shape = film.model.shapes[named->segment->shape];
  std::vector<wire::Matrix> bones;
  for (const wire::Track& bone : view.bones_of(segment)) bones.push_back(view.matrix_at(bone, frame));
  if (!bones.empty()) return modeler::BentSkin(bones, segment.blend).patches_of(*shape.net);
  std::vector<wire::Patch> patches = shape.patches;
  for (wire::Patch& patch : patches)
    for (auto& point : patch.points) {
      const glm::dvec3 place = modeler::placed(view.matrix_at(segment, frame), point);
      point = {float(place.x), float(place.y), float(place.z)};
    }
  return patches;
}

// All over the parts whose names begin with "anna/left" and end so.
Points sole(const FilmOfAnna& film, const std::string& side, std::uint32_t frame) {
  Points points;
  for (const wire::Segment& segment : film.compiled.view().segments()) {
    const std::string name(film.compiled.view().name(segment));
    if (!name.starts_with("anna/" + side) ||
        !std::ranges::any_of(kSoles, [&](std::string_view end) { return name.ends_with(end); }))
      continue;
    for (const wire::Patch& patch : patches_at(film, segment, name.substr(std::string_view("anna/").size()), frame))
      for (const double u : {0.0, 0.5, 1.0})
        for (const double v : {0.0, 0.5, 1.0}) points.push_back(modeler::point_of(patch, u, v));
  }
  return points;
}

double lowest(const Points& points) {
  double least = 1e9;
  for (const glm::dvec3& point : points) least = std::min(least, point.z);
  return least;
}

glm::dvec3 middle(const Points& points) {
  glm::dvec3 sum(0);
  for (const glm::dvec3& point : points) sum += point;
  return sum / double(points.size());
}

class Feet {
 public:
  Feet(const document::Json& film, const Performed& performed, double leg)
      : film_(read(film)),
        performed_(performed),
        leg_(leg),
        floor_(std::min(lowest(sole(film_, "left", 0)), lowest(sole(film_, "right", 0)))) {}

  void expect_footing(const std::string& what, double slide = kSlide) {
    for (std::uint32_t frame = performed_.first; frame <= performed_.last; ++frame) look(frame);
    EXPECT_LT(slid_, slide) << what;
    EXPECT_LT(through_, kThrough) << what;
    EXPECT_LT(floating_, kDown) << what;
    EXPECT_GT(held_, 300u) << what << ": points that were measured";
    ::testing::Test::RecordProperty(what, "slides " + std::to_string(slid_) + ", through " + std::to_string(through_));
  }

  // Of gaits with a flight; returns for how many frames no foot is down.
  int expect_landings(const std::string& what) {
    int flown = 0;
    for (std::uint32_t frame = performed_.first; frame <= performed_.last; ++frame) {
      floating_ = 0;
      look(frame);
      flown += floating_ > kDown;
    }
    EXPECT_LT(slid_, kSlide) << what;
    EXPECT_LT(through_, kThrough) << what;
    EXPECT_GT(held_, 300u) << what << ": points that were measured";
    return flown;
  }

  void expect_no_sinking(const std::string& what) {
    for (std::uint32_t frame = performed_.first; frame <= performed_.last; ++frame) look(frame);
    EXPECT_LT(through_, kThrough) << what;
    EXPECT_LT(floating_, kDown) << what;
  }

  glm::dvec3 at(std::uint32_t frame) const {
    return 0.5 * (middle(sole(film_, "left", frame)) + middle(sole(film_, "right", frame)));
  }
  glm::dvec3 way() const { return at(performed_.last) - at(performed_.first); }

 private:
  void look(std::uint32_t frame) {
    double least = 1e9;
    for (const std::string side : {"left", "right"}) {
      const Points points = sole(film_, side, frame);
      landed_[side].resize(points.size());
      least = std::min(least, (lowest(points) - floor_) / leg_);
      through_ = std::max(through_, (floor_ - lowest(points)) / leg_);
      for (std::size_t i = 0; i < points.size(); ++i) follow(points[i], landed_[side][i]);
    }
    floating_ = std::max(floating_, least);
  }

  void follow(const glm::dvec3& point, std::optional<glm::dvec3>& landed) {
    if (point.z > floor_ + kDown * leg_) return landed.reset();
    if (!landed) landed = point;
    slid_ = std::max(slid_, std::hypot(point.x - landed->x, point.y - landed->y) / leg_);
    ++held_;
  }

  FilmOfAnna film_;
  Performed performed_;
  double leg_, floor_;
  std::map<std::string, std::vector<std::optional<glm::dvec3>>> landed_;
  double slid_ = 0, through_ = 0, floating_ = 0;  // of the leg
  std::size_t held_ = 0;
};

std::vector<Build> people() {
  return {{"man", human(), 2.42},
          {"child", built(0.6, 0.85, 1.05), 2.42 * 0.6 * 0.85},
          {"tall", built(1, 1.15, 0.95), 2.42 * 1.15},
          {"stout", built(0.95, 0.9, 1.4), 2.42 * 0.95 * 0.9}};
}

std::vector<Build> everybody() {
  std::vector<Build> builds = people();
  builds.push_back({"robot", robot(), 87});
  builds.push_back({"bird", bird(), 1});
  return builds;
}

TEST(Feet, OfAllBuildsStayWhereTheyStandInAWalk) {
  for (const Build& build : everybody()) {
    document::Json film = film_with(build.model);
    const Performed performed = act(film, "walk steps 5", 5);
    Feet feet(film, performed, build.leg);
    feet.expect_footing(build.name + " walks");
    EXPECT_NEAR(glm::length(feet.way()) / build.leg, 5 * 0.616, 0.05) << build.name;
  }
}

// With less than half of its keys, as splines: no longer to 2 mm, but to 3.
TEST(Feet, StayInAWalkWhoseKeysAreReduced) {
  for (const Build& build : people()) {
    document::Json film = film_with(build.model);
    const Performed performed = act(film, "walk steps 6", 5);
    const animator::Reduction done =
        animator::reduce_keys(film, read(film), {false, "anna", {}}, {0, performed.last}, {0.03, {}});
    EXPECT_LT(2 * done.keys_after, done.keys_before) << build.name;
    Feet(film, performed, build.leg).expect_footing(build.name + " walks on few keys", 1.5 * kSlide);
  }
}

TEST(Feet, OfLegsOfOnePieceStayWhateverTheProportions) {
  for (const double leg : {0.5, 1.0, 2.0})
    for (const double aside : {0.02, 0.05, 0.1, 0.15, 0.3})
      for (const char* words : {"walk steps 4", "walk steps 4 step-length 0.1", "walk turn 90", "turn"}) {
        document::Json film = film_with(stilts(leg, aside * leg, {}));
        const Performed performed = act(film, words, 5);
        Feet(film, performed, leg)
            .expect_footing(std::to_string(leg) + " " + std::to_string(aside) + " " + words,
                            aside < kNarrow ? kNarrowSlide : kSlide);
      }
}

// The foot that passes the other brushes the floor, for hips that are hinges neither lift it nor carry it
// round.
TEST(Feet, OfLegsOfOnePieceOnHingesDoNotSink) {
  for (const double aside : {0.02, 0.1, 0.3}) {
    document::Json film = film_with(stilts(1, aside, {{"y", {-60, 60}}}));
    const Performed performed = act(film, "walk steps 4", 5);
    Feet(film, performed, 1).expect_no_sinking(std::to_string(aside));
  }
}

TEST(Feet, StayInOtherStylesAndOnBows) {
  const std::vector<Build> builds = people();
  std::size_t first = 0;  // two builds each, every build three times
  for (const char* words : {"walk steps 4 lean 12 bounce 2 knee-lift 1.5 arm-swing 2", "walk steps 8 turn 120 pace 1.5",
                            "walk distance 6 steps 7 first left", "walk to -3 4", "turn by -135", "turn to 0 9"})
    for (int i = 0; i < 2; ++i) {
      const Build& build = builds[first++ % builds.size()];
      document::Json film = film_with(build.model);
      const Performed performed = act(film, words, 5);
      Feet(film, performed, build.leg).expect_footing(build.name + " " + words);
    }
}

TEST(Feet, StayWhileAFigureSitsDownAndStandsUp) {
  std::vector<Build> builds = people();
  builds.push_back({"robot", robot(), 87});
  for (const Build& build : builds) {
    document::Json film = film_with(build.model);
    for (const char* words : {"sit", "stand"}) {
      const Performed performed = act(film, words);
      Feet(film, performed, build.leg).expect_footing(build.name + " " + words);
    }
  }
}

std::vector<Build> with_knees() {
  std::vector<Build> builds = people();
  builds.push_back({"robot", robot(), 87});
  return builds;
}

void expect_flights(const std::vector<Build>& builds, const char* words, int least) {
  for (const Build& build : builds) {
    document::Json film = film_with(build.model);
    const int flown = Feet(film, act(film, words, 5), build.leg).expect_landings(build.name + " " + words);
    EXPECT_GE(flown, least) << build.name << " " << words;
  }
}

TEST(Feet, StayWhereTheyLandInARun) {
  expect_flights(with_knees(), "run steps 5", 5);
  for (const char* words : {"run steps 1", "run distance 9 pace 3 lean 6 turn 60", "run to -6 9"})
    expect_flights({people()[0]}, words, 2);
}

TEST(Feet, LeaveAndLandTogetherInAJump) {
  expect_flights(with_knees(), "jump", 9);
  for (const char* words : {"jump distance 1.6", "jump distance -0.6", "jump turn 180", "jump height 0.4"})
    expect_flights({people()[1]}, words, 5);
}

// Of four legs the length is from the hip to the floor.
std::vector<Build> animals() { return {{"horse", example("horse"), 3.4}, {"dog", example("dog"), 1.4}}; }

TEST(Feet, OfFourLegsStayWhereTheyStand) {
  for (const char* words : {"walk steps 6 turn 40", "turn by -60"})
    for (const Build& build : animals()) {
      document::Json film = film_with(build.model);
      Feet(film, act(film, words, 5), build.leg).expect_footing(build.name + " " + words);
    }
}

TEST(Feet, OfFourLegsStayWhereTheyLandInATrotAndAGallop) {
  expect_flights(animals(), "trot strides 3", 3);
  expect_flights(animals(), "gallop strides 3", 4);
  expect_flights({animals()[1]}, "gallop distance 9 turn 40 pace 2.6", 3);
}

// Of the frames in the middle of a gait, for how many the feet are down that its footfalls say.
TEST(FourLegs, WalkInFourBeatsAndTrotInPairs) {
  const auto together = [](const char* words, const char* one, const char* other) {
    document::Json film = film_with(animals()[0].model);
    const Performed done = act(film, words, 0);
    const animator::Film shown = read(film);
    int same = 0;
    const auto high = [&](const char* joint, std::uint32_t frame) {
      const modeler::Model& model = shown.models[0];
      const auto found = std::ranges::find(model.joints, std::string(joint), &modeler::Joint::name);
      return frame_in(model, posture_at(model, shown.actors[0].motion, frame), found - model.joints.begin()).place.z >
             0.35;
    };
    for (std::uint32_t frame = 24; frame < 56; ++frame) same += high(one, frame) == high(other, frame);
    return same / 32.0;
  };
  EXPECT_GT(together("trot strides 6", "left-hind-hoof", "right-fore-hoof"), 0.9);
  EXPECT_LT(together("trot strides 6", "left-hind-hoof", "left-fore-hoof"), 0.4);
  EXPECT_LT(together("walk steps 8", "left-hind-hoof", "right-fore-hoof"), 0.75);
}

// The hips' second differences are the acceleration, as long as no foot is down.
TEST(Jumping, FliesByGravity) {
  document::Json film = film_with(human());
  const Performed done = act(film, "jump height 1 gravity 20 distance 2", 0);
  const animator::Film shown = read(film);
  const Body body = body_of(shown.models[0], "anna", "test");
  const auto hips = [&](std::uint32_t frame) {
    return frame_in(shown.models[0], posture_at(shown.models[0], shown.actors[0].motion, frame), body.pelvis).place;
  };
  double top = 0;
  int falling = 0;
  for (std::uint32_t frame = 1; frame < done.last; ++frame) {
    const glm::dvec3 change = hips(frame - 1) - 2.0 * hips(frame) + hips(frame + 1);
    falling += std::abs(change.z * 24 * 24 + 20) < 1.5;
    top = std::max(top, hips(frame).z);
  }
  EXPECT_GE(falling, 13);
  EXPECT_NEAR(top - hips(0).z, 1.2, 0.1) << "it leaves on its toes";
}

TEST(Walking, GoesOnFromWhereTheFigureStandsAndLooks) {
  document::Json film = film_with(human());
  act(film, "turn by 60", 0);
  const Performed performed = act(film, "walk steps 3 step-length 1.5");
  const glm::dvec3 way = Feet(film, performed, 2.42).way();
  EXPECT_NEAR(std::atan2(way.y, way.x) * 180 / M_PI, 90, 1.5);
  EXPECT_NEAR(glm::length(way), 4.5, 0.05);
}

TEST(Turning, GoesBeyondHalfATurn) {
  document::Json film = film_with(human());
  const Performed performed = act(film, "turn by 200", 0);
  Feet(film, performed, 2.42).expect_footing("turn by 200");
  const animator::Film shown = read(film);
  const Body body = body_of(shown.models[0], "anna", "test");
  const double heading = body.heading_of(posture_at(shown.models[0], shown.actors[0].motion, performed.last));
  EXPECT_NEAR(std::remainder(heading - 230, 360), 0, 0.1);
}

TEST(Walking, GoesToAPlace) {
  document::Json film = film_with(human());
  const Performed performed = act(film, "walk to -6 3", 0);
  const glm::dvec3 end = Feet(film, performed, 2.42).at(performed.last);
  EXPECT_LT(std::hypot(end.x + 6, end.y - 3), 0.35) << "soles reach farther ahead of the ankles than behind";
}

}  // namespace
}  // namespace mars::motion
