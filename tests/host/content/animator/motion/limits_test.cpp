// What actions make of a figure: within its limits, from where it was, reported clearly where it cannot be done.
#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "host/content/animator/motion/body/body.h"
#include "host/content/animator/motion/body/stance.h"
#include "tests/host/content/animator/motion/bodies.h"
#include "tests/host/content/document/failure_of.h"
#include "tests/processor_time.h"

namespace mars::motion {
namespace {

constexpr double kLimitRounding = 1e-4;  // degrees

struct Shown {
  explicit Shown(const document::Json& film) : film(read(film)), body(body_of(film_model(), "anna", "test")) {}

  const modeler::Model& film_model() const { return film.models[0]; }
  Posture at(std::uint32_t frame) const { return posture_at(film_model(), film.actors[0].motion, frame); }
  glm::dvec3 place(std::size_t joint, std::uint32_t frame) const {
    return frame_in(film_model(), at(frame), joint).place;
  }

  animator::Film film;
  Body body;
};

const char* const kAll[] = {"walk steps 4",
                            "walk steps 4 turn -90",
                            "turn by 120",
                            "wave",
                            "wave hand left times 1",
                            "nod depth 40",
                            "sit",
                            "wave",
                            "nod",
                            "stand",
                            "walk to 9 9 arm-swing 1.5"};

void expect_limits_kept(const document::Json& film, const Performed& done, const std::string& what) {
  const Shown shown(film);
  for (std::uint32_t frame = done.first; frame <= done.last; ++frame) {
    const Posture posture = shown.at(frame);
    for (std::size_t i = 0; i < posture.pose.size(); ++i)
      for (int axis = 0; axis < 3; ++axis) {
        const modeler::Limits& limits = shown.film_model().joints[i].limits[axis];
        EXPECT_GE(posture.pose[i][axis], limits.lower - kLimitRounding)
            << what << " " << frame << shown.body.joint_name(i);
        EXPECT_LE(posture.pose[i][axis], limits.upper + kLimitRounding)
            << what << " " << frame << shown.body.joint_name(i);
      }
  }
}

TEST(Actions, KeepTheLimitsAtEveryFrame) {
  document::Json film = film_with(human());
  for (const char* words : kAll) expect_limits_kept(film, act(film, words), words);
  for (const char* words : {"run steps 5", "jump distance 1.5 turn 60", "jump height 1.2"})
    expect_limits_kept(film, act(film, words), words);
}

TEST(Actions, OfFourLegsKeepTheLimitsAtEveryFrame) {
  for (const char* name : {"horse", "dog"}) {
    document::Json film = film_with(example(name));
    for (const char* words : {"walk steps 4", "trot strides 3", "turn by 70", "gallop strides 4", "nod"})
      expect_limits_kept(film, act(film, words), std::string(name) + " " + words);
  }
}

// No joint's speed changes by more, from a frame to the next, than a foot's that comes down.
TEST(Actions, GoOnWithoutAJump) {
  document::Json film = film_with(human());
  std::uint32_t last = 0;
  for (const char* words : kAll) last = act(film, words).last;
  const Shown shown(film);
  for (const std::size_t joint : shown.body.joints()) {
    std::vector<glm::dvec3> places;
    for (std::uint32_t frame = 0; frame <= last; ++frame) places.push_back(shown.place(joint, frame));
    for (std::size_t frame = 1; frame < last; ++frame)
      EXPECT_LT(glm::length(places[frame - 1] - 2.0 * places[frame] + places[frame + 1]),
                0.07 * shown.body.leg_length())
          << shown.body.joint_name(joint) << " at frame " << frame;
  }
}

TEST(Actions, BeginWithWhatTheFigureDoes) {
  document::Json film = film_with(human());
  film["actors"][0]["pose"] = {{"left-upper-arm", {60, 0, 0}}, {"spine", {0, 15, 0}}};
  const Shown before(film);
  act(film, "walk steps 2", 12);
  const Shown after(film);
  for (const std::size_t joint : before.body.joints())
    EXPECT_LT(glm::distance(before.place(joint, 12), after.place(joint, 12)), 0.003) << before.body.joint_name(joint);
}

TEST(Actions, AskedAgainReplaceWhatTheyHadMade) {
  document::Json once = film_with(human()), twice = once;
  act(once, "walk steps 3", 5);
  act(twice, "walk steps 3 lean 10 pace 1.9", 5);
  act(twice, "walk steps 3", 5);
  EXPECT_TRUE(twice == once);
}

TEST(Actions, ThatCannotBeAreRefusedBeforeAnyWorkIsDone) {
  struct Impossible {
    const char *words, *reported;
    double rate = 24;
    std::uint32_t at = 0;
  };
  const test::ProcessorTime time;
  for (const auto& [words, reported, rate, at] : {
           Impossible{"walk steps 1e6", "'steps' is 1e6 (give a number from 1 to 2000)"},
           Impossible{"walk steps -3", "'steps' is -3 (give a number from 1 to 2000)"},
           Impossible{"run pace 99", "'pace' is 99 (give a number from 0.1 to 10)"},
           Impossible{"walk distance 1e6", "'distance' is 1000000 away, which takes"},
           Impossible{"walk to 1e6 1e6", "a way has at most 2000: go to a nearer place"},
           Impossible{"walk steps 4 distance 1e6", "would take a step of 250000, where two legs of"},
           Impossible{"walk step-length 100", "take shorter steps"},
           Impossible{"walk steps 2000 pace 0.1", "would end at frame 4804440", 240},
           Impossible{"turn by 3600 pace 0.1", "a film has at most 1000000 frames", 1000},
           Impossible{"nod times 1000 seconds 60",
                      "nod: would end at frame 1440000 (begin earlier, or make it shorter"},
           Impossible{"wave times 1000 seconds 60", "would end at frame 1440024"},
           Impossible{"spin seconds 600", "would end at frame 1500000", 1000, 900'000},
           Impossible{"throw seconds 600", "would end at frame 1500000", 1000, 900'000},
       }) {
    document::Json film = film_with(human());
    film["rate"] = rate;
    const std::string failure = document::failure_of([&] { act(film, words, at); });
    EXPECT_TRUE(document::holds(failure, reported)) << words << ": " << failure;
  }
  EXPECT_LT(time.seconds(), 10);
}

TEST(Walk, SwingsArmsAgainstLegsAndBendsKneesForward) {
  document::Json film = film_with(human());
  const Performed done = act(film, "walk steps 6", 0);
  const Shown shown(film);
  const glm::dvec3 forward = canonical_turn(0, 0, 30)[0];
  int opposite = 0, frames = 0;
  for (std::uint32_t frame = 30; frame + 30 < done.last; ++frame, ++frames) {
    const auto ahead = [&](modeler::Limb limb) {
      return glm::dot(shown.place(shown.body.find(limb, modeler::Side::left), frame) -
                          shown.place(shown.body.find(limb, modeler::Side::right), frame),
                      forward);
    };
    opposite += ahead(modeler::Limb::ankle) * ahead(modeler::Limb::wrist) < 0;
    for (const modeler::Side side : kSides) {
      const glm::dvec3 hip = shown.place(shown.body.leg(side).hip, frame),
                       knee = shown.place(shown.body.leg(side).knee, frame),
                       ankle = shown.place(shown.body.leg(side).ankle, frame);
      EXPECT_GT(glm::dot(knee - 0.5 * (hip + ankle), forward), -1e-3) << frame;
    }
  }
  EXPECT_GT(opposite, frames * 3 / 4);
}

TEST(Sit, HasThighsLevelFeetDownAndHandsOnThighs) {
  document::Json film = film_with(human());
  const Performed done = act(film, "sit", 0);
  const Shown shown(film);
  for (const modeler::Side side : kSides) {
    const Leg& leg = shown.body.leg(side);
    const glm::dvec3 hip = shown.place(leg.hip, done.last), knee = shown.place(leg.knee, done.last);
    EXPECT_NEAR(hip.z, knee.z, 0.01 * leg.thigh);
    EXPECT_NEAR(glm::distance(glm::dvec2(knee), glm::dvec2(shown.place(leg.ankle, done.last))), 0, 0.2 * leg.shin);
    const glm::dvec3 hand = shown.place(shown.body.find(modeler::Limb::wrist, side), done.last);
    EXPECT_GT(hand.z, knee.z);
    EXPECT_LT(glm::distance(hand, 0.5 * (hip + knee)), 0.5 * leg.thigh);
  }
  EXPECT_NE(done.report.find("seat of height 1.0895"), std::string::npos) << done.report;
}

TEST(Sit, OnASeatOfAnotherHeight) {
  document::Json film = film_with(human());
  const Performed low = act(film, "sit seat-height 0.9", 0);
  const double hips = Shown(film).place(Shown(film).body.pelvis, low.last).z;
  document::Json other = film_with(human());
  const Performed high = act(other, "sit seat-height 1.3", 0);
  EXPECT_NEAR(Shown(other).place(Shown(other).body.pelvis, high.last).z - hips, 0.4, 1e-3);
}

TEST(Wave, RaisesTheHandAndMovesItToAndFro) {
  for (const std::string hand : {"left", "right"}) {
    document::Json film = film_with(human());
    const Performed done = act(film, "wave times 2 hand " + hand, 0);
    const Shown shown(film);
    const modeler::Side side = hand == "left" ? modeler::Side::left : modeler::Side::right;
    const std::size_t wrist = shown.body.find(modeler::Limb::wrist, side),
                      shoulder = shown.body.find(modeler::Limb::shoulder, side);
    EXPECT_GT(shown.place(wrist, 12).z, shown.place(shoulder, 12).z + 0.2 * shown.body.leg_length());
    EXPECT_GT(glm::distance(shown.place(wrist, 12), shown.place(wrist, 18)), 0.15 * shown.body.leg_length());
    EXPECT_LT(glm::distance(shown.place(wrist, 0), shown.place(wrist, done.last)), 1e-3);
  }
}

TEST(Nod, BendsTheHeadAsDeepAsAskedAndComesBack) {
  document::Json film = film_with(human());
  const Performed done = act(film, "nod times 1 depth 30 seconds 1", 0);
  const Shown shown(film);
  const std::size_t head = shown.body.find(modeler::Trunk::head);
  const auto bent = [&](std::uint32_t frame) {
    return glm::degrees(
        animator::turn_between(shown.body.turn_of(shown.at(0), head), shown.body.turn_of(shown.at(frame), head)).angle);
  };
  EXPECT_NEAR(bent(11), 30, 0.25);
  EXPECT_NEAR(bent(done.last), 0, 0.01);
}

// After a turn its feet point outward, which such ankles cannot do for a figure that sits.
TEST(Sit, IsDoneByFiguresWhoseAnklesDoNotTwist) {
  for (const char* before : {"turn", "walk steps 2"}) {
    document::Json film = film_with(limited(human(), "-foot", "z", {0, 0}));
    for (const char* words : {before, "sit", "stand"}) EXPECT_NO_THROW(act(film, words)) << before << words;
  }
}

TEST(Turn, TakesSmallerStepsWhereLimitsWantIt) {
  for (const char* words : {"turn by 90", "walk turn 200"}) {
    document::Json free = film_with(human()), narrow = film_with(limited(human(), "-thigh", "z", {-10, 10}));
    const Performed quick = act(free, words, 0), slow = act(narrow, words, 0);
    EXPECT_GT(slow.last, quick.last) << words;
    const Shown a(free), b(narrow);
    EXPECT_NEAR(a.body.heading_of(a.at(quick.last)), b.body.heading_of(b.at(slow.last)), 0.1) << words;
  }
}

// "head", "left shoulder" and "left elbow" only.
document::Json bust() {
  document::Json model = human();
  const document::Json limbs = model["limbs"];
  model["limbs"] = {{"head", limbs["head"]},
                    {"left", {{"shoulder", limbs["left"]["shoulder"]}, {"elbow", limbs["left"]["elbow"]}}}};
  return model;
}

TEST(Gestures, NeedNoLegsAndNoHands) {
  document::Json film = film_with(bust()), whole = film_with(human());
  EXPECT_NO_THROW(act(film, "nod", 0));
  act(film, "wave hand left", 0);
  act(whole, "wave hand left", 0);
  const animator::Film a = read(film), b = read(whole);
  const modeler::Model& model = b.models[0];
  const std::size_t wrist = model.limbs.of(modeler::Limb::wrist, modeler::Side::left);
  for (const std::uint32_t frame : {12u, 18u})
    EXPECT_LT(glm::distance(frame_in(a.models[0], posture_at(a.models[0], a.actors[0].motion, frame), wrist).place,
                            frame_in(model, posture_at(model, b.actors[0].motion, frame), wrist).place),
              0.25);
}

std::string refused(const document::Json& model, const std::string& words) {
  document::Json film = film_with(model);
  return document::failure_of([&] { act(film, words, 0); });
}

TEST(Actions, SayWhatIsInTheWay) {
  EXPECT_EQ(refused(human(), "stand"),
            "actor 'anna', stand: stands already at frame 0 (let it sit down first, by the action sit)");
  EXPECT_NE(refused(robot(), "turn").find("cannot turn about"), std::string::npos) << refused(robot(), "turn");
  EXPECT_NE(refused(human(), "walk step-length 2.6").find("at its limit of"), std::string::npos)
      << refused(human(), "walk step-length 2.6");
  EXPECT_NE(refused(limited(human(), "-foot", "y", {0, 0}), "sit back 0.1").find("'left-foot'"), std::string::npos)
      << refused(limited(human(), "-foot", "y", {0, 0}), "sit back 0.1");
  EXPECT_EQ(refused(robot(), "wave"),
            "actor 'anna': its model names no right elbow, which 'wave' needs "
            "(add it to the model's limbs: docs/model-format.md)");
  EXPECT_EQ(refused(bird(), "sit"),
            "actor 'anna': its model names no left knee, which 'sit' needs "
            "(add it to the model's limbs: docs/model-format.md)");
  document::Json seated = film_with(human());
  act(seated, "sit", 0);
  EXPECT_NE(document::failure_of([&] { act(seated, "sit"); }).find("give --at with the frame where it began"),
            std::string::npos);
  EXPECT_EQ(refused(human(), "nod depth 100"),
            "nod: 'depth' is 100 degrees, but 'neck' and 'head' can bend 70 from where they are "
            "(nod less, or widen the joint's limits in its model)");
  EXPECT_EQ(refused(human(), "walk steps 0"), "walk: 'steps' is 0 (give a number from 1 to 2000)");
  EXPECT_EQ(refused(human(), "walk to 1 1 distance 3"), "walk: 'to' stands beside distance (give one of them)");
  EXPECT_EQ(refused(human(), "wave hand lft"), "wave: 'hand' is 'lft' (did you mean 'left'?)");
}

TEST(Actions, SayHowManyLegsTheyNeed) {
  EXPECT_EQ(
      refused(human(), "trot"),
      "actor 'anna': has no four legs, which 'trot' needs (let it walk or run, or name its forelegs in its model's "
      "limbs: docs/model-format.md)");
  for (const char* words : {"run", "jump", "sit", "stand"})
    EXPECT_NE(refused(example("dog"), words).find("has four legs, which '" + std::string(words) + "' does not move"),
              std::string::npos)
        << refused(example("dog"), words);
  const std::string narrow = refused(limited(example("horse"), "fore-arm", "y", {-8, 8}), "gallop");
  EXPECT_NE(narrow.find("fore foot cannot be where it stands"), std::string::npos) << narrow;
  EXPECT_NE(narrow.find("fore-arm' is at its limit"), std::string::npos) << narrow;
  EXPECT_NE(refused(bird(), "run").find("names no left knee, which 'run' needs"), std::string::npos);
  EXPECT_NE(refused(limited(human(), "-shin", "y", {0, 20}), "jump").find("-shin' is at its limit of 20"),
            std::string::npos)
      << refused(limited(human(), "-shin", "y", {0, 20}), "jump");
}

document::Json with_places(const std::vector<std::pair<std::string, document::Json>>& places) {
  document::Json model = human();
  for (document::Json& joint : model["joints"])
    for (const auto& [name, place] : places)
      if (joint["name"] == name) joint["place"] = place;
  return model;
}

TEST(Actions, LegsThatTellNoDirectionAreRefused) {
  const document::Json together = with_places({{"left-thigh", {0, 0, -0.2}}, {"right-thigh", {0, 0, -0.2}}});
  const document::Json above = with_places({{"left-thigh", {0, 0, 0}}, {"right-thigh", {0, 0, -0.5}}});
  const document::Json none = with_places({{"right-shin", {0, 0, 0}}, {"right-foot", {0, 0, 0}}});
  for (const char* words : {"walk", "turn", "sit", "nod", "wave"}) {
    EXPECT_EQ(refused(together, words),
              "actor 'anna': its hips are at one place "
              "(in its model, place the hips beside each other and the ankles below them)");
    EXPECT_NE(refused(above, words).find("leg points from one hip to the other"), std::string::npos);
    EXPECT_NE(refused(none, words).find("its right leg has no length"), std::string::npos);
  }
}

TEST(Actions, DoNotEndBehindWhatAFilmCanHave) {
  document::Json film = film_with(human());
  EXPECT_EQ(document::failure_of([&] { act(film, "spin seconds 600", 999'000); }),
            "actor 'anna', spin: would end at frame 1013400 "
            "(begin earlier, or make it shorter: a film has at most 1000000 frames)");
}

// A key that holds does not hold the nod that begins at that key.
TEST(Nod, GoesOnEvenlyFromAKeyThatIsThere) {
  document::Json film = film_with(human());
  film["actors"][0]["keys"] = document::Json::parse(R"([{"frame": 0, "pose": {"head": [0, 0, 0]}, "ease": "hold"}])");
  act(film, "nod", 0);
  const Shown shown(film);
  const auto& keys = shown.film.actors[0].motion.pose[shown.body.find(modeler::Trunk::head)];
  ASSERT_GT(keys.size(), 2u);
  for (const auto& key : keys) EXPECT_EQ(key.ease, animator::kLinear) << key.frame;
}

}  // namespace
}  // namespace mars::motion
