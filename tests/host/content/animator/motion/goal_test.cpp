// Actions that have a goal: hands come where things are, things stay in them and land where they are tossed, feet stay
// where they stand, for figures of several builds.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "host/content/animator/pose/actor_state.h"
#include "host/content/animator/pose/joint_frames.h"
#include "host/content/animator/motion/body/body.h"
#include "host/content/animator/motion/body/hand.h"
#include "host/content/animator/motion/body/surface.h"
#include "host/content/animator/motion/scene/target.h"
#include "host/content/animator/pose/attachments.h"
#include "tests/host/content/animator/motion/bodies.h"
#include "tests/host/content/document/failure_of.h"

namespace mars::motion {
namespace {

constexpr double kMetre = 2.9;  // of the man
constexpr double kMillimetre = kMetre / 1000;
constexpr double kRounding = 1e-4;                    // degrees
constexpr double kBall = 0.3;                         // radius
const glm::dmat3 kFacing = canonical_turn(0, 0, 30);  // of anna
const glm::dvec3 kStands(1, 2, 0);

struct Figure {
  std::string name;
  document::Json model;
  double size;
};

std::vector<Figure> figures() {
  return {{"man", human(), 1}, {"child", built(0.6, 0.85, 1.05), 0.6}, {"stout", built(0.95, 0.9, 1.4), 0.95}};
}

document::Json box(const document::Json& sbb) {
  return {{"joints", document::Json::array({jointed("box", "", {0, 0, 0}, {}, sbb)})}};
}

// With a ball before and to the right of the figure, its middle so high.
document::Json film_of(const Figure& figure, double ahead, double aside, double height, double radius = kBall) {
  document::Json film = film_with(figure.model);
  const double r = radius * figure.size;
  film["models"]["ball"] = {
      {"joints", document::Json::array({jointed("ball", "", {0, 0, 0}, {}, {{-r, -r, -r}, {r, r, r}}, "sphere")})}};
  const glm::dvec3 place = kStands + figure.size * (kFacing * glm::dvec3(ahead, aside, height));
  film["actors"].push_back({{"name", "ball"}, {"model", "ball"}, {"place", {place.x, place.y, place.z}}});
  return film;
}

std::string at(const glm::dvec3& place) {
  return document::shown(place.x) + " " + document::shown(place.y) + " " + document::shown(place.z);
}

glm::dvec3 before(const Figure& figure, const glm::dvec3& place) { return kStands + figure.size * (kFacing * place); }

void expect_limits(const animator::Film& film, const Performed& done, const std::string& what) {
  const modeler::Model& model = film.models[film.actors[0].model];
  for (std::uint32_t frame = done.first; frame <= done.last; ++frame) {
    const Posture posture = posture_at(model, film.actors[0].motion, frame);
    for (std::size_t i = 0; i < posture.pose.size(); ++i)
      for (int axis = 0; axis < 3; ++axis) {
        EXPECT_GE(posture.pose[i][axis], model.joints[i].limits[axis].lower - kRounding)
            << what << " " << frame << " " << model.joints[i].name;
        EXPECT_LE(posture.pose[i][axis], model.joints[i].limits[axis].upper + kRounding)
            << what << " " << frame << " " << model.joints[i].name;
      }
  }
}

// Of both ankles, from the first frame.
void expect_feet(const animator::Film& film, const Performed& done, double most, const std::string& what) {
  const modeler::Model& model = film.models[film.actors[0].model];
  animator::JointFrames frames(film);
  for (const modeler::Side side : kSides) {
    const std::size_t ankle = model.limbs.of(modeler::Limb::ankle, side);
    const glm::dvec3 stood = frames.frame_of(0, ankle, done.first).place;
    for (std::uint32_t frame = done.first; frame <= done.last; ++frame)
      EXPECT_LT(glm::distance(frames.frame_of(0, ankle, frame).place, stood), most) << what << " " << frame;
  }
}

// The thing and the hand never jump: their speed changes little from frame to frame.
void expect_smooth(const animator::Film& film, std::size_t actor, std::size_t joint, std::uint32_t first,
                   std::uint32_t last, double most, const std::string& what) {
  animator::JointFrames frames(film);
  const auto place = [&](std::uint32_t frame) { return frames.frame_of(actor, joint, frame).place; };
  for (std::uint32_t frame = first + 1; frame < last; ++frame)
    EXPECT_LT(glm::length(place(frame - 1) - 2.0 * place(frame) + place(frame + 1)), most) << what << " " << frame;
}

std::uint32_t first_attached(const animator::Film& film) { return film.actors[1].attach.front().frame; }

TEST(Pick, TakesABallFromTheFloorAndFromATable) {
  for (const Figure& figure : figures())
    for (const double height : {0.3, 1.9, 3.0}) {
      document::Json json = film_of(figure, height < 1 ? 1.2 : 1.3, -0.3, height);
      const glm::dvec3 lay = read(json).actors[1].motion.place[0].value;
      const Performed done = act(json, "pick what ball", 3);
      const animator::Film film = read(json);
      const std::string what = figure.name + " at " + std::to_string(height);
      const std::uint32_t contact = first_attached(film);
      animator::JointFrames frames(film);
      const Body body = body_of(film.models[film.actors[0].model], "anna", "test");
      const Hand hand = hand_of(body, modeler::Side::right, "test");
      const modeler::Axes there = frames.frame_of(0, hand.end, contact);
      EXPECT_LT(glm::distance(there.turn * hand.around(kBall * figure.size) + there.place, lay),
                kMillimetre * figure.size)
          << what;
      EXPECT_LT(glm::distance(frames.root_of(1, contact).place, lay), 1e-7) << what;
      EXPECT_LT(glm::distance(frames.root_of(1, contact - 1).place, lay), 1e-7) << what;
      const glm::dvec3 held = animator::seen_from(there, frames.root_of(1, contact)).place;
      for (std::uint32_t frame = contact; frame <= done.last + 5; ++frame) {
        const glm::dvec3 now = animator::seen_from(frames.frame_of(0, hand.end, frame), frames.root_of(1, frame)).place;
        EXPECT_LT(glm::distance(now, held), 1e-9) << what << " " << frame;
        const double low = height < 1 || frame < contact + 5 ? lay.z - 1e-3 : 0;
        EXPECT_GT(frames.root_of(1, frame).place.z, low) << what << " " << frame;
      }
      expect_limits(film, done, what);
      expect_feet(film, done, 2 * kMillimetre * figure.size, what);
      expect_smooth(film, 0, hand.end, done.first, done.last, 0.17 * figure.size, what);
    }
}

constexpr const char* kDigits[] = {"thumb", "index", "middle", "ring", "little"};

std::size_t joint_named(const modeler::Model& model, const std::string& name) {
  for (std::size_t joint = 0; joint < model.joints.size(); ++joint)
    if (model.joints[joint].name == name) return joint;
  ADD_FAILURE() << name;
  return 0;
}

// How far the nearest point of what moves with a joint is from the ball's surface; below 0: inside.
double gap_to_ball(const animator::Film& film, std::size_t joint, std::uint32_t frame, double radius) {
  const modeler::Model& model = film.models[film.actors[0].model];
  const glm::dvec3 ball = animator::state_at(film, 1, frame).root.place;
  double least = 1e300;
  for (const glm::dvec3& point : points_of(model, posture_at(model, film.actors[0].motion, frame),
                                           [&](std::size_t each) { return each == joint; }))
    least = std::min(least, glm::distance(point, ball) - radius);
  return least;
}

TEST(Pick, ClosesFingersRoundTheThingAndPutOpensThem) {
  for (const auto& [figure, ball] : {std::pair{figures()[0], 0.13}, std::pair{figures()[1], kBall}}) {
    document::Json json = film_of(figure, 1.2, -0.3, 1.9, ball);
    const Performed picked = act(json, "pick what ball hand right", 0);
    const Performed put = act(json, "put to " + at(before(figure, {1.3, -0.3, 1.9})));
    const animator::Film film = read(json);
    const modeler::Model& model = film.models[film.actors[0].model];
    const double radius = ball * figure.size, millimetre = kMillimetre * figure.size;
    for (const std::string digit : kDigits) {
      const std::string what = figure.name + " " + digit;
      const std::size_t root = joint_named(model, "right-" + digit + "-1"),
                        tip = joint_named(model, "right-" + digit + "-3");
      double nearest = 1e300;
      for (const std::size_t joint : {root, root + 1, tip})
        nearest = std::min(nearest, gap_to_ball(film, joint, picked.last, radius));
      EXPECT_GT(nearest, -1.5 * millimetre) << what;
      EXPECT_LT(gap_to_ball(film, tip, picked.last, radius), 4 * millimetre) << what;
      EXPECT_GT(gap_to_ball(film, tip, first_attached(film), radius), 8 * millimetre) << what;
      for (const std::size_t joint : {root, root + 1, tip}) {
        const auto pose = [&](std::uint32_t frame) {
          return posture_at(model, film.actors[0].motion, frame).pose[joint];
        };
        EXPECT_EQ(pose(picked.last), pose(put.first)) << what;
        EXPECT_LT(glm::length(pose(put.last)), 0.01) << what;
      }
    }
    expect_limits(film, picked, figure.name);
    expect_limits(film, put, figure.name);
  }
}

// The model with other words in all names.
document::Json renamed(const document::Json& model, const std::vector<std::pair<std::string, std::string>>& words) {
  std::string text = model.dump();
  for (const auto& [word, other] : words)
    for (std::size_t at = 0; (at = text.find(word, at)) != std::string::npos; at += other.size())
      text.replace(at, word.size(), other);
  return document::Json::parse(text);
}

TEST(Pick, KnowsFingersOfOtherProgramsByTheirNames) {
  const auto bends = [](const document::Json& model) {
    document::Json json = film_of({"man", model, 1}, 1.2, -0.3, 1.9, 0.13);
    const Performed picked = act(json, "pick what ball hand right", 0);
    const animator::Film film = read(json);
    const modeler::Model& man = film.models[film.actors[0].model];
    double most = 0;
    for (std::size_t joint = 0; joint < man.joints.size(); ++joint)
      if (modeler::is_at_or_below(man.joints, man.joints[joint].parent,
                                  man.limbs.of(modeler::Limb::wrist, modeler::Side::right)))
        most = std::max(most, glm::length(posture_at(man, film.actors[0].motion, picked.last).pose[joint]));
    return std::pair{most, picked.last};
  };
  const auto own = bends(human());
  EXPECT_GT(own.first, 20);
  EXPECT_EQ(bends(renamed(human(), {{"right-thumb-", "mixamorig:RightHandThumb"},
                                    {"right-index-", "mixamorig:RightHandIndex"},
                                    {"right-middle-", "mixamorig:RightHandMiddle"},
                                    {"right-ring-", "mixamorig:RightHandRing"},
                                    {"right-little-", "mixamorig:RightHandPinky"}})),
            own);
  EXPECT_EQ(bends(renamed(human(), {{"right-thumb-", "Bip01 R Finger0"},
                                    {"right-index-", "Bip01 R Finger1"},
                                    {"right-middle-", "Bip01 R Finger2"},
                                    {"right-ring-", "Bip01 R Finger3"},
                                    {"right-little-", "Bip01 R Finger4"}})),
            own);
  // Where names say nothing, fingers stay, and the hand does not wait for them.
  const auto none =
      bends(renamed(human(), {{"thumb", "a"}, {"index", "b"}, {"middle", "c"}, {"-ring", "d"}, {"little", "e"}}));
  EXPECT_EQ(none.first, 0);
  EXPECT_LT(none.second, own.second);
}

TEST(Pick, SaysWhereToWalkToWhatIsTooFarAway) {
  document::Json json = film_of(figures()[0], 6, 0, 0.3);
  const std::string failure = document::failure_of([&] { act(json, "pick what ball", 0); });
  EXPECT_TRUE(document::holds(failure, "its right hand cannot reach 6.2 5 0.3")) << failure;
  const std::size_t words = failure.find("walk to ");
  ASSERT_NE(words, std::string::npos) << failure;
  act(json, failure.substr(words, failure.find(')', words) - words), 0);
  act(json, "pick what ball");
}

TEST(Pick, TakesFromAnothersHandAndRefusesNonsense) {
  document::Json json = film_of(figures()[0], 1.2, -0.3, 0.3);
  for (const auto& [words, reported] :
       {std::pair{"pick", "'what' is missing"},
        std::pair{"pick what bal", "no actor of the film (did you mean 'ball'?)"},
        std::pair{"pick what anna", "is the figure itself"},
        std::pair{"put to 1 1 1", "does not hold anything in a hand at frame 0"},
        std::pair{"toss to 1 1 1", "does not hold anything in a hand at frame 0"},
        std::pair{"reach", "'to' is missing"}, std::pair{"reach of ball limb hnd", "which is no joint"},
        std::pair{"plant", "nothing moves after frame 0"}}) {
    const std::string failure = document::failure_of([&, text = words] { act(json, text, 0); });
    EXPECT_TRUE(document::holds(failure, reported)) << words << ": " << failure;
  }
  act(json, "pick what ball", 0);
  json["actors"].push_back(json["actors"][0]);
  json["actors"][2] = {{"name", "bert"}, {"model", "figure"}};
  const glm::dvec3 ball = animator::state_at(read(json), 1, 100).root.place;
  const glm::dvec3 place = ball + kFacing * glm::dvec3(1.2, -0.3, 0);
  json["actors"][2]["place"] = {place.x, place.y, 0};
  json["actors"][2]["turn"] = {0, 0, 210};
  perform(json, read(json), "bert", *find_action("pick"), 60, Arguments({{"what", {"ball"}}}, "pick"));
  const animator::Film film = read(json);
  EXPECT_EQ(film.actors[1].attach.back().value->actor, 2u);
  animator::JointFrames frames(film);
  const std::uint32_t taken = film.actors[1].attach.back().frame;
  EXPECT_LT(glm::distance(frames.root_of(1, taken).place, frames.root_of(1, taken - 1).place), 1e-3);
}

TEST(Pick, LeavesTheArmAsItIsWhileTheFigureWalks) {
  document::Json json = film_of(figures()[0], 1.2, -0.3, kBall);
  const Performed picked = act(json, "pick what ball hand right", 0);
  const Performed walked = act(json, "walk steps 3");
  const animator::Film film = read(json);
  const modeler::Model& model = film.models[film.actors[0].model];
  for (const modeler::Limb limb : {modeler::Limb::shoulder, modeler::Limb::elbow, modeler::Limb::wrist}) {
    const std::size_t joint = model.limbs.of(limb, modeler::Side::right);
    EXPECT_EQ(posture_at(model, film.actors[0].motion, walked.last - 9).pose[joint],
              posture_at(model, film.actors[0].motion, picked.last).pose[joint]);
  }
}

TEST(Put, PutsWhatItHoldsDownAtAPlace) {
  for (const Figure& figure : figures()) {
    document::Json json = film_of(figure, 1.2, -0.3, kBall);
    act(json, "pick what ball", 0);
    const glm::dvec3 to = before(figure, {1.4, -0.4, 2.0});
    const Performed done = act(json, "put to " + at(to));
    const animator::Film film = read(json);
    animator::JointFrames frames(film);
    EXPECT_FALSE(film.actors[1].attach.back().value);
    EXPECT_LT(glm::distance(frames.root_of(1, done.last).place, to), kMillimetre * figure.size) << figure.name;
    EXPECT_LT(glm::distance(frames.root_of(1, film.actors[1].attach.back().frame - 1).place, to), 0.1 * figure.size);
    expect_limits(film, done, figure.name);
    expect_feet(film, done, 2 * kMillimetre * figure.size, figure.name);
  }
}

// A board that stands on an edge at rest, 2 high, and lies 1 over the floor when its skin's joint turns.
document::Json board() {
  const document::Json bones = document::Json::array({{0, 1}, {0, 1}, {0, 1}, {0, 1}, {0, 1}, {0, 1}, {0, 1}, {0, 1}});
  return document::Json::parse(R"({"shapes": {"board": {"mesh": {
      "vertices": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0], [0, 0, 1], [1, 0, 1], [0, 1, 1], [1, 1, 1]],
      "faces": [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]], "bones": )" +
                               bones.dump() + R"(}}},
    "joints": [{"name": "wall", "segment": {"shape": "board", "sbb": [[-0.1, -1, 0.9], [0.1, 1, 2.9]],
                "skin": {"joints": ["hinge"]}}},
               {"name": "hinge", "parent": "wall", "place": [0, 0, 1]}]})");
}

TEST(Seats, AreWhereSkinsAreBent) {
  document::Json json = film_with(human());
  json["models"]["board"] = board();
  json["actors"].push_back(
      {{"name", "bed"}, {"model", "board"}, {"place", {5, 2, 0}}, {"pose", {{"hinge", {0, 90, 0}}}}});
  const animator::Film film = read(json);
  const Arguments none({}, "test");
  const Scene scene{film, film.actors[0], 0, none, "sit"};
  for (const Target& target : {Target{1}, Target{1, 0}, Target{1, 1}}) {
    const Block block = block_of(scene, target, 0);
    EXPECT_NEAR(block.top(), 1.1, 1e-6);
    EXPECT_NEAR(block.bottom(), 0.9, 1e-6);
    EXPECT_NEAR(block.middle.x, 5.9, 1e-6);
  }
  EXPECT_NEAR(place_of(film, {1}, 0).x, 5.9, 1e-6);
  act(json, "sit on bed", 0);
  const animator::Film sat = read(json);
  const std::size_t pelvis = sat.models[0].limbs.of(modeler::Trunk::pelvis);
  const std::uint32_t last = animator::last_key(sat.actors[0]);
  EXPECT_LT(animator::JointFrames(sat).frame_of(0, pelvis, last).place.z, 2);
  EXPECT_GT(animator::JointFrames(sat).frame_of(0, pelvis, last).place.z, 1.1);
}

TEST(Toss, HitsItsPlaceAndBounces) {
  for (const Figure& figure : figures())
    for (const glm::dvec3& goal : {glm::dvec3(5, 0.5, 0), glm::dvec3(3, -1, 2.5)}) {
      document::Json json = film_of(figure, 1.2, -0.3, kBall);
      act(json, "pick what ball", 0);
      glm::dvec3 to = before(figure, goal);
      const Performed done = act(json, "toss gravity 28.4 to " + at(to));
      to.z = std::max(to.z, kBall * figure.size);
      const animator::Film film = read(json);
      animator::JointFrames frames(film);
      const std::uint32_t released = film.actors[1].attach.back().frame;
      double nearest = 1e300, lowest = 1e300;
      for (std::uint32_t frame = released; frame <= done.film_last; ++frame) {
        nearest = std::min(nearest, glm::distance(frames.root_of(1, frame).place, to));
        lowest = std::min(lowest, frames.root_of(1, frame).place.z);
      }
      EXPECT_LT(nearest, kMillimetre) << figure.name;
      EXPECT_NEAR(lowest, kBall * figure.size, 1e-2) << figure.name;
      // It leaves the hand as it moved in it: no slower than half, no faster than twice, about in that direction.
      const glm::dvec3 swung = frames.root_of(1, released).place - frames.root_of(1, released - 1).place;
      const glm::dvec3 flies = frames.root_of(1, released + 1).place - frames.root_of(1, released).place;
      EXPECT_GT(glm::dot(glm::normalize(swung), glm::normalize(flies)), 0.8) << figure.name;
      EXPECT_GT(glm::length(flies), 0.5 * glm::length(swung)) << figure.name;
      EXPECT_LT(glm::length(flies), 2.2 * glm::length(swung)) << figure.name;
      expect_limits(film, done, figure.name);
      expect_feet(film, done, 2 * kMillimetre * figure.size, figure.name);
    }
}

TEST(Toss, FliesByTheGravityOfTheFiguresScale) {
  for (const Figure& figure : figures()) {
    if (figure.name == "child") continue;  // whose legs are short for its size
    document::Json json = film_of(figure, 1.2, -0.3, kBall);
    act(json, "pick what ball", 0);
    act(json, "toss to " + at(before(figure, {5, 0.5, 0})));
    const animator::Film film = read(json);
    animator::JointFrames frames(film);
    const std::uint32_t released = film.actors[1].attach.back().frame;
    const auto height = [&](std::uint32_t frame) { return frames.root_of(1, released + frame).place.z; };
    const double gravity = (2 * height(4) - height(0) - height(8)) * std::pow(film.rate / 4, 2);
    EXPECT_NEAR(gravity, 9.81 * kMetre * figure.size, 0.15 * gravity) << figure.name;
  }
}

TEST(Toss, WantsThatTheFigureLooksThere) {
  document::Json json = film_of(figures()[0], 1.2, -0.3, kBall);
  act(json, "pick what ball", 0);
  const std::string failure = document::failure_of([&] {
    act(json, "toss to " + at(before(figures()[0], {0, 5, 0})));
  });
  EXPECT_TRUE(document::holds(failure, "degrees to its left (let it turn there first: turn to")) << failure;
}

TEST(Reach, BringsAPalmAFootAndAHeadToAPlaceAndStays) {
  struct Wanted {
    const char* words;
    glm::dvec3 place;
    modeler::Limb limb;
  };
  for (const Figure& figure : figures())
    for (const Wanted& wanted : {Wanted{"reach along limb", {0.9, -0.8, 3.6}, modeler::Limb::wrist},
                                 Wanted{"reach along body seconds 1.5", {1.2, -0.5, 0.9}, modeler::Limb::wrist},
                                 Wanted{"reach limb right-foot", {0.7, -0.4, 1}, modeler::Limb::ankle}}) {
      document::Json json = film_of(figure, 3, 0, 1);
      const glm::dvec3 to = before(figure, wanted.place);
      const Performed done = act(json, wanted.words + (" to " + at(to)), 2);
      const animator::Film film = read(json);
      const Body body = body_of(film.models[film.actors[0].model], "anna", "test");
      const std::size_t end = body.find(wanted.limb, modeler::Side::right);
      const glm::dvec3 held =
          wanted.limb == modeler::Limb::wrist ? hand_of(body, modeler::Side::right, "test").grip : glm::dvec3(0);
      animator::JointFrames frames(film);
      const modeler::Axes there = frames.frame_of(0, end, done.last + 7);
      EXPECT_LT(glm::distance(there.turn * held + there.place, to), kMillimetre * figure.size)
          << figure.name << ": " << wanted.words;
      expect_limits(film, done, wanted.words);
      expect_smooth(film, 0, end, done.first, done.last, 0.05 * figure.size, wanted.words);
      if (wanted.limb == modeler::Limb::wrist) expect_feet(film, done, 2 * kMillimetre * figure.size, wanted.words);
    }
}

TEST(Reach, SaysHowMuchIsMissing) {
  document::Json json = film_of(figures()[0], 3, 0, 1);
  const std::string failure = document::failure_of([&] { act(json, "reach of ball along limb", 0); });
  EXPECT_TRUE(document::holds(failure, "'right-hand' cannot reach")) << failure;
  EXPECT_TRUE(document::holds(failure, "are missing (let the figure go nearer first")) << failure;
}

TEST(Plant, KeepsFeetAndAHandWhileTheRestMoves) {
  for (const Figure& figure : figures())
    for (const char* words : {"plant", "plant seconds 0.8", "plant limb right-hand"}) {
      document::Json json = film_of(figure, 3, 0, 1);
      const double s = figure.size;
      // The whole figure sways, and sinks a little.
      const glm::dvec3 way = kStands + kFacing * (s * glm::dvec3(-0.05, 0.12, -0.1));
      json["actors"][0]["keys"] = {
          {{"frame", 4}, {"place", {kStands.x, kStands.y, kStands.z}}, {"pose", {{"right-forearm", {0, -60, 0}}}}},
          {{"frame", 30}, {"place", {way.x, way.y, way.z}}}};
      json["actors"][0].erase("place");
      const Performed done = act(json, words, 4);
      const animator::Film film = read(json);
      expect_limits(film, done, words);
      if (std::string(words).find("hand") == std::string::npos) {
        expect_feet(film, done, kMillimetre * s, figure.name + " " + words);
        continue;
      }
      animator::JointFrames frames(film);
      const std::size_t wrist = film.models[film.actors[0].model].limbs.of(modeler::Limb::wrist, modeler::Side::right);
      for (std::uint32_t frame = done.first; frame <= done.last; ++frame)
        EXPECT_LT(glm::distance(frames.frame_of(0, wrist, frame).place, frames.frame_of(0, wrist, done.first).place),
                  kMillimetre * s)
            << figure.name << " " << frame;
    }
}

// A chair with a back, behind, before or beside which the figure stands.
TEST(Sit, WalksToANamedSeatAndSitsOnIt) {
  for (const Figure& figure : figures())
    for (const glm::dvec3& place : {glm::dvec3(5, 1, 0), glm::dvec3(-4, 0, 0), glm::dvec3(-0.9, 0, 0)}) {
      document::Json json = film_with(figure.model);
      const double s = figure.size;
      json["models"]["chair"] = {
          {"joints",
           document::Json::array(
               {jointed("seat", "", {0, 0, 0}, {}, {{-0.6 * s, -0.6 * s, 0.9 * s}, {0.6 * s, 0.6 * s, 1.15 * s}}),
                jointed("back", "", {0, 0, 0}, {}, {{-0.7 * s, -0.6 * s, 1.2 * s}, {-0.6 * s, 0.6 * s, 2.6 * s}})})}};
      const glm::dvec3 at = before(figure, place);
      json["actors"].push_back(
          {{"name", "chair"}, {"model", "chair"}, {"place", {at.x, at.y, 0}}, {"turn", {0, 0, 30}}});
      const Performed done = act(json, "sit on chair", 0);
      const animator::Film film = read(json);
      const std::string what = figure.name + " " + std::to_string(place.x);
      const modeler::Model& model = film.models[film.actors[0].model];
      animator::JointFrames frames(film);
      const glm::dvec3 hips = frames.frame_of(0, model.limbs.of(modeler::Trunk::pelvis), done.last).place;
      const glm::dvec3 off = glm::transpose(kFacing) * (hips - at);
      EXPECT_LT(std::abs(off.y), 0.2 * s) << what;
      EXPECT_LT(std::abs(off.x), 0.6 * s) << what << ": over the seat";
      EXPECT_NEAR(off.z, (1.15 + 0.26) * s, 0.12 * s) << what;
      const Body body = body_of(model, "anna", "test");
      const double looks = body.heading_of(posture_at(model, film.actors[0].motion, done.last));
      EXPECT_LT(std::abs(std::remainder(looks - 30, 360.0)), 13) << what << ": away from its back";
      expect_limits(film, done, what);
      const std::uint32_t down = done.last - 38;  // 1.6 s
      expect_feet(film, {down, done.last, done.last, ""}, 2 * kMillimetre * s, what);
    }
}

TEST(Sit, SaysWhyASeatWillNotDo) {
  document::Json json = film_with(human());
  json["models"]["tower"] = box({{-1, -1, 0}, {1, 1, 5}});
  json["actors"].push_back({{"name", "tower"}, {"model", "tower"}, {"place", {5, 0, 0}}});
  const auto failure = [&](const char* words) { return document::failure_of([&] { act(json, words, 0); }); };
  EXPECT_TRUE(document::holds(failure("sit on tower"), "out of this figure's reach")) << failure("sit on tower");
  EXPECT_TRUE(document::holds(failure("sit on tower/top"), "no joint of the model")) << failure("sit on tower/top");
  EXPECT_TRUE(document::holds(failure("sit on tower seat-height 1"), "stands beside on"));
}

}  // namespace
}  // namespace mars::motion
