#include "host/content/animator/motion/script/action.h"

#include <algorithm>

#include "hal/failure/failure.h"
#include "host/content/animator/pose/attachments.h"
#include "host/content/animator/motion/goals/gesture.h"
#include "host/content/animator/motion/gaits/jumping.h"
#include "host/content/animator/motion/laws/kinematic.h"
#include "host/content/animator/motion/scene/gravity.h"
#include "host/content/animator/motion/goals/picking.h"
#include "host/content/animator/motion/goals/reaching.h"
#include "host/content/animator/motion/gaits/running.h"
#include "host/content/animator/motion/goals/seat.h"
#include "host/content/animator/motion/goals/sitting.h"
#include "host/content/animator/motion/gaits/steps.h"
#include "host/content/animator/motion/gaits/striding.h"
#include "host/content/animator/motion/goals/tossing.h"
#include "host/content/animator/motion/script/resting.h"

namespace mars::motion {
namespace {

constexpr Parameter kStepRate{"pace", "N", "steps a second; default: 2", "1.5"};

constexpr Parameter kStepCount{
    "steps", "N",
    "number of steps, without the last that brings the feet together; default: 4, or as the distance needs", "6"};
constexpr Parameter kDistance{"distance", "D", "length of the way; default: from the number of steps", "3.5"};
constexpr Parameter kTo{"to", "X Y", "a place on the floor; the figure turns to it first", "2 -1"};
constexpr Parameter kBow{"turn", "DEGREES", "go along an arc, to the left by this angle; default: straight on", "90"};
constexpr Parameter kFirst{
    "first", "SIDE", "the foot that steps first, left or right; default: right, along an arc the inner foot", "left"};
constexpr Parameter kArmSwing{"arm-swing", "N", "times the ordinary one, 0 to 3; default: 1", "1.5"};
constexpr Parameter kUpAndDown{"bounce", "N", "up and down, times the ordinary one, 0 to 3; default: 1", "0.5"};
constexpr Parameter kKneeLift{"knee-lift", "N", "of the swinging leg, times the ordinary one, 0 to 3; default: 1",
                              "1.4"};
constexpr Parameter kForwardLean{"lean", "DEGREES", "of the trunk, forward; default: 0", "8"};

constexpr Parameter kWalkParameters[] = {
    kStepCount,
    kDistance,
    kTo,
    kBow,
    {"step-length", "D", "default: 0.62 of the leg; on four legs half the hips' height", "0.7"},
    kStepRate,
    kFirst,
    kArmSwing,
    kUpAndDown,
    kKneeLift,
    kForwardLean};
constexpr Parameter kRunParameters[] = {kStepCount,
                                        kDistance,
                                        kTo,
                                        kBow,
                                        {"step-length", "D", "default: 1.15 of the leg", "1.3"},
                                        {"pace", "N", "steps a second; default: 2.7", "3"},
                                        kFirst,
                                        kArmSwing,
                                        kUpAndDown,
                                        kKneeLift,
                                        kForwardLean};
constexpr Parameter kStrideCount{"strides", "N", "number of strides; default: 4, or as the distance needs", "6"};
constexpr Parameter kTrotParameters[] = {kStrideCount,
                                         kDistance,
                                         kTo,
                                         kBow,
                                         {"stride-length", "D", "default: 1.65 of the hips' height", "2.5"},
                                         {"pace", "N", "strides a second; default: 1.6", "2.2"},
                                         kUpAndDown,
                                         kKneeLift};
constexpr Parameter kGallopParameters[] = {kStrideCount,
                                           kDistance,
                                           kTo,
                                           kBow,
                                           {"stride-length", "D", "default: 2.8 times the hips' height", "6"},
                                           {"pace", "N", "strides a second; default: 2", "2.6"},
                                           kUpAndDown,
                                           kKneeLift};
constexpr Parameter kJumpParameters[] = {
    {"height", "H", "how far the hips rise after the feet have left the floor; default: 0.35 of the leg", "1"},
    {"distance", "D", "forward, negative backward; default: 0", "2.5"},
    {"turn", "DEGREES", "to the left while it flies; default: 0", "180"},
    {"gravity", "G", "units per second squared; default: 9.81 for a leg of 0.835 units, for others in proportion",
     "28"}};
constexpr Parameter kTurnParameters[] = {{"by", "DEGREES", "to the left; default: 90", "-90"},
                                         {"to", "X Y", "to face this place on the floor", "2 -1"},
                                         kStepRate};
constexpr Parameter kSitParameters[] = {
    {"on", "ACTOR[/JOINT]", "the seat: an actor, or the segment of one of its joints; the figure walks there first",
     "bench"},
    {"seat-height", "H", "height of the seat above the floor; default: thighs are level", "0.45"},
    {"back", "D", "distance of the hips behind the feet; default: shins are upright", "0.4"},
    {"seconds", "S", "default: 1.6", "2"}};
constexpr Parameter kStandParameters[] = {{"seconds", "S", "default: 1.6", "2"}};
constexpr Parameter kNodParameters[] = {{"times", "N", "default: 2", "3"},
                                        {"depth", "DEGREES", "default: 24", "15"},
                                        {"seconds", "S", "of one nod; default: 0.6", "0.8"}};
constexpr Parameter kWaveParameters[] = {{"hand", "SIDE", "left or right; default: right", "left"},
                                         {"times", "N", "default: 3", "5"},
                                         {"seconds", "S", "to and fro; default: 0.5", "0.4"}};
constexpr Parameter kSpinning{"spin", "X Y Z", "degrees a second about the world's axes; default: none", "0 360 0"};
constexpr Parameter kVelocity{"velocity", "X Y Z", "units a second; default: none", "2 0 5"};
constexpr Parameter kThrowParameters[] = {
    kVelocity,
    {"acceleration", "X Y Z", "units per second squared; default: straight down, by the same gravity as bounce",
     "0 0 -28"},
    kSpinning,
    {"seconds", "S", "default: 1", "1.5"}};
constexpr Parameter kBounceParameters[] = {
    kVelocity,
    {"gravity", "G", kGravityMeaning, "28"},
    {"floor", "Z", "height of the floor that the figure's lowest point hits; default: 0", "0.5"},
    {"restitution", "N", "part of the upward speed that an impact leaves, 0 to 0.99; default: 0.7", "0.8"},
    {"friction", "N",
     "part of the speed along the floor, and of the spin, that an impact removes, 0 to 1; default: 0.1", "0.3"},
    kSpinning,
    {"seconds", "S", "default: until the actor is at rest", "3"}};
constexpr Parameter kSpinParameters[] = {{"axis", "AXIS", "of the world: x, y or z; default: z", "x"},
                                         {"degrees", "DEGREES", "default: 360", "-720"},
                                         {"seconds", "S", "default: 2", "4"}};
constexpr Parameter kGoParameters[] = {{"to", "X Y Z", "the place to which the actor goes; required", "2 0 0"},
                                       {"seconds", "S", "default: 1", "2"},
                                       {"ease", "EASE", "linear, in, out or both; default: both", "out"}};

const Action kActions[] = {
    {"walk", "Walk: some steps, a distance, to a place, or along an arc", "hips, ankles", kWalkParameters, walk},
    {"run", "Run: some steps, a distance, to a place, or along an arc", "hips, knees, ankles", kRunParameters, run},
    {"jump", "Jump from both feet to both feet, up, forward or turning", "hips, knees, ankles", kJumpParameters, jump},
    {"trot", "Trot, on four legs", "hips, ankles, shoulders", kTrotParameters, trot},
    {"gallop", "Gallop, on four legs", "hips, ankles, shoulders", kGallopParameters, gallop},
    {"turn", "Turn on the spot, by stepping", "hips, ankles", kTurnParameters, turn},
    {"sit", "Sit down on a seat behind the figure, or on a seat of the film", "hips, knees, ankles", kSitParameters,
     sit},
    {"stand", "Stand up from sitting", "hips, knees, ankles", kStandParameters, stand},
    {"reach", "Bring a hand, a foot or another joint to a place", "the limb that reaches", reach_parameters(), reach},
    {"plant", "Keep feet or hands where they are, while the rest of the body moves", "the limbs that stay",
     plant_parameters(), plant},
    {"pick", "Bend down or reach out for an actor and take it", "hips, ankles, shoulder, elbow", pick_parameters(),
     pick},
    {"put", "Put down at a place the thing that a hand holds", "hips, ankles, shoulder, elbow", put_parameters(), put},
    {"toss", "Toss the thing that a hand holds to a place, where it bounces", "hips, ankles, shoulder, elbow",
     toss_parameters(), toss},
    {"nod", "Nod with head and neck", "head or neck", kNodParameters, nod},
    {"wave", "Raise a hand, wave and lower it", "shoulder, elbow", kWaveParameters, wave},
    {"throw", "Fly with a velocity and an acceleration", "", kThrowParameters, fling},
    {"bounce", "Fall and bounce on a floor until at rest", "", kBounceParameters, bounce},
    {"spin", "Spin evenly about an axis of the world", "", kSpinParameters, spin},
    {"go", "Go straight to a place", "", kGoParameters, go},
};

// Everything that the keys hold, as one key.
animator::ActorKey all_of(std::span<const animator::ActorKey> keys) {
  animator::ActorKey all;
  for (const animator::ActorKey& key : keys) {
    if (key.place) all.place = key.place;
    if (key.turn) all.turn = key.turn;
    if (key.attach) all.attach = key.attach;
    all.pose.insert(key.pose.begin(), key.pose.end());
  }
  return all;
}

// Where another actor carries it, keys of its place would count for nothing.
void refuse_carried(const Scene& scene, const animator::ActorKey& driven) {
  if (driven.attach || !(driven.place || driven.turn)) return;
  animator::refuse_carried(scene.film, scene.actor, scene.at, scene.where());
}

bool is_about_hands(const Action& action) {
  return std::any_of(action.parameters.begin(), action.parameters.end(), [](const Parameter& parameter) {
    return parameter.name == "hand" || parameter.name == "limb" || parameter.name == "what";
  });
}

bool holds_nothing(const animator::ActorKey& key) { return !key.place && !key.turn && !key.attach && key.pose.empty(); }

// The arm of a hand that holds something stays as it is: it neither swings nor rests.
void keep_holding(const Scene& scene, Motion& motion) {
  const std::vector<modeler::Joint>& joints = scene.model().joints;
  for (const animator::Actor& thing : scene.film.actors) {
    const animator::Attachment* const carrier = animator::attachment_at(thing, scene.at);
    if (!carrier || &scene.film.actors[carrier->actor] != &scene.actor) continue;
    for (const modeler::Side side : {modeler::Side::left, modeler::Side::right}) {
      const std::size_t shoulder = scene.model().limbs.of(modeler::Limb::shoulder, side);
      std::vector<std::string> arm;
      std::size_t joint = carrier->joint;
      for (; joint != modeler::kNone && joint != shoulder; joint = joints[joint].parent)
        arm.push_back(joints[joint].name);
      if (joint == modeler::kNone) continue;
      arm.push_back(joints[shoulder].name);
      for (animator::ActorKey& key : motion.keys)
        for (const std::string& name : arm) key.pose.erase(name);
    }
  }
}

// Whether arms that stand as they are drawn hang from then on: not of what moves as a whole or stays where it is.
bool lets_arms_hang(const Action& action) { return !action.needs.empty() && action.perform != plant; }

Motion performed(const Scene& scene, const Action& action) {
  const auto hanging = lets_arms_hang(action) ? hanging_arms(scene) : std::nullopt;
  Motion motion;
  if (hanging) {
    const animator::Film film = with_key(scene, *hanging);
    const auto number = static_cast<std::size_t>(&scene.actor - scene.film.actors.data());
    motion = action.perform({film, film.actors[number], scene.at, scene.arguments, scene.action});
    motion.keys.insert(motion.keys.begin(), *hanging);
  } else {
    motion = action.perform(scene);
  }
  if (!is_about_hands(action)) keep_holding(scene, motion);
  leave_out_idle(scene, motion.keys);
  std::erase_if(motion.keys, holds_nothing);
  return motion;
}

}  // namespace

std::size_t Parameter::count() const {
  return 1 + static_cast<std::size_t>(std::count(value.begin(), value.end(), ' '));
}

std::span<const Action> actions() { return kActions; }

const Action* find_action(std::string_view name) {
  const auto found =
      std::find_if(std::begin(kActions), std::end(kActions), [&](const Action& a) { return a.name == name; });
  return found == std::end(kActions) ? nullptr : found;
}

Performed perform(document::Json& json, const animator::Film& film, const std::string& name, const Action& action,
                  std::optional<std::uint32_t> at, const Arguments& arguments) {
  animator::actor_of(json, name);  // refuses what is no actor
  const animator::Actor& actor =
      *std::find_if(film.actors.begin(), film.actors.end(), [&](const animator::Actor& a) { return a.name == name; });
  if (!actor.matrices.empty())
    throw Failure("is moved by matrices", "actor '" + name + "'",
                  "take its matrices out of the film, or name another actor");
  const Scene scene{film, actor, at ? *at : animator::last_key(actor), arguments, action.name};
  Motion motion = performed(scene, action);
  // Where it is elsewhere afterwards, what followed was meant for another place.
  const animator::ActorKey driven = all_of(motion.keys);
  refuse_carried(scene, driven);
  animator::clear_keys(json, name, scene.at + 1, driven.place ? wire::kMostFrames : motion.last, driven);
  animator::put_keys(json, name, motion.keys);
  std::uint32_t film_last = motion.last;
  for (const auto& [other, keys] : motion.others) {
    film_last = std::max(film_last, keys.back().frame);
    animator::clear_keys(json, other, keys.front().frame + 1, wire::kMostFrames, all_of(keys));
    animator::put_keys(json, other, keys);
  }
  return {scene.at, motion.last, film_last, motion.report};
}

}  // namespace mars::motion
