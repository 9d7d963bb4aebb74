#include "host/content/animator/pose/attachments.h"

#include <algorithm>

#include "hal/failure/failure.h"

namespace mars::animator {

const Attachment* attachment_at(const Actor& actor, std::uint32_t frame) {
  if (actor.attach.empty() || frame < actor.attach.front().frame) return nullptr;
  const auto& held = actor.attach[stretch_at(actor.attach, frame).from].value;
  return held ? &*held : nullptr;
}

void refuse_carried(const Film& film, const Actor& actor, std::uint32_t frame, const std::string& where) {
  const Attachment* const carrier = attachment_at(actor, frame);
  if (carrier != nullptr)
    throw Failure("is carried by '" + film.actors[carrier->actor].name + "' at frame " + std::to_string(frame), where,
                  "detach it there first");
}

std::uint32_t last_key(const Actor& actor) {
  const std::uint32_t last = last_key(actor.motion);
  return actor.attach.empty() ? last : std::max(last, actor.attach.back().frame);
}

std::vector<std::size_t> chain_at(const std::vector<Actor>& actors, std::size_t actor, std::uint32_t frame) {
  std::vector<std::size_t> chain{actor};
  while (const Attachment* carrier = attachment_at(actors[chain.back()], frame)) {
    if (carrier->actor == actor || chain.size() > kLongestChain) break;
    chain.push_back(carrier->actor);
  }
  return chain;
}

}  // namespace mars::animator
