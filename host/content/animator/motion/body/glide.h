// From postures at every frame to keys: only where the way between keys would stray.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "host/content/animator/keys/edit.h"
#include "host/content/animator/motion/body/body.h"

namespace mars::motion {

// Puts keys on the first and last of `count` frames and between them as far apart as `strays(from, to, at)`
// allows for all frames that lie between two.
void choose_keys(std::size_t count, const std::function<bool(std::size_t, std::size_t, std::size_t)>& strays,
                 const std::function<void(std::size_t)>& put);

// Whether a joint that turns from `a` to `b` is, that part of the way, more than `tolerance` degrees from
// `is`, or outside its limits.
bool strays(const modeler::Joint& joint, const glm::dvec3& a, const glm::dvec3& b, double part, const glm::dvec3& is,
            double tolerance);

// The joint's numbers with two digits, within its limits.
glm::dvec3 two_digits(const modeler::Joint& joint, const glm::dvec3& pose);

// What `start` is off the first posture fades over `frames`, so that motion begins where the figure was.
void begin_at(const modeler::Model& model, const Posture& start, double frames, std::vector<Posture>& postures);

// Keys of `joints`, place and turn for postures of the frames from `first` on. Joints of the legs and what
// carries them stray at most 0.03 degrees between keys, others 0.3, places by 1/5000 of the leg: feet stay
// where they stand.
std::vector<animator::ActorKey> keys_of(const Body& body, std::span<const std::size_t> joints,
                                        std::span<const Posture> postures, std::uint32_t first);

// Keys of joints alone, which stray `degrees` at most.
std::vector<animator::ActorKey> keys_of_joints(const modeler::Model& model, std::span<const std::size_t> joints,
                                               std::span<const Posture> postures, std::uint32_t first,
                                               double tolerance);

}  // namespace mars::motion
