#include "host/render/sinks/unseen_rivals.h"

namespace mars::sinks {

bool UnseenRivals::may_have_ended(const RunFiles& run, const FolderTurn& turn, const std::string& reason) {
  if (turn.sees(run)) return false;
  const auto now = std::chrono::steady_clock::now();
  const double last_sign = FolderTurn::last_sign_of(run);
  const auto [found, is_new] = seen_.try_emplace(run.run, Seen{last_sign, now});
  if (is_new && warn_)
    warn_(reason + ", but cannot be seen from here: waiting until it shows that it runs, or its claim is a minute old");
  return last_sign <= found->second.last_sign && now - found->second.since < kPatience;
}

}  // namespace mars::sinks
