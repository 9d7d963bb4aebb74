// What pages ask for of a film's keys and curves, sent when they ask and whenever it changes.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "host/studio/stage/stage.h"

namespace mars::studio {

class AnimationPages {
 public:
  using Tell = std::function<void(PageNumber page, const Json& message)>;

  // The project must outlive it.
  AnimationPages(Project& project, Tell tell) : project_(project), tell_(std::move(tell)) {}

  // Whether the message is for it: channels, curves, actions, script or scripts.
  static bool is_for_it(const Json& message);
  // Such a message. Throws Failure or Json::exception where it makes no sense.
  void take(PageNumber page, const Json& message);
  void page_closed(PageNumber page) { pages_.erase(page); }

  void keys_changed();    // of the film: channels and curves
  void values_changed();  // by a gesture: curves alone

 private:
  struct Wanted {
    std::vector<std::string> things;
    std::optional<CurvesWanted> curves;
  };

  void send_channels(PageNumber page, const Wanted& wanted);
  void send_curves(PageNumber page, const Wanted& wanted);

  Project& project_;
  Tell tell_;
  std::map<PageNumber, Wanted> pages_;
};

}  // namespace mars::studio
