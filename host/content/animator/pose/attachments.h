// What carries an actor, at any frame.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "host/content/animator/pose/film.h"

namespace mars::animator {

// The most actors that carry each other in a row.
inline constexpr std::size_t kLongestChain = 1000;

// Null where the actor stands by its own keys.
const Attachment* attachment_at(const Actor& actor, std::uint32_t frame);
const Attachment* attachment_at(const Actor&&, std::uint32_t) = delete;

// Throws Failure if something carries the actor at the frame: numbers of its place and turn then mean another frame of
// reference. `where`: of the message.
void refuse_carried(const Film& film, const Actor& actor, std::uint32_t frame, const std::string& where);

// The last frame at which the actor has a key of anything but matrices; 0 if it has none.
std::uint32_t last_key(const Actor& actor);

// The actors from this one to the one that nothing carries, or to where they go round in a circle or are more than
// kLongestChain: then the last one is carried, too.
std::vector<std::size_t> chain_at(const std::vector<Actor>& actors, std::size_t actor, std::uint32_t frame);

}  // namespace mars::animator
