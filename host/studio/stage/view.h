// One view of one page: what it is to show, what its page has, and what the renderer was asked for.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "host/preview/drawing.h"
#include "host/studio/stage/eye.h"
#include "host/studio/stage/ghosts.h"
#include "host/studio/stage/handles.h"
#include "host/studio/stage/interval.h"
#include "host/studio/stage/line_pictures.h"
#include "host/studio/stage/screen.h"

namespace mars::studio {

// What a picture shows, but for its controls.
struct Shown {
  std::uint64_t moment = 0;  // Moments::number()
  wire::Camera camera{};

  bool operator==(const Shown&) const = default;
};

// A picture that the renderer draws.
struct Asked {
  std::uint32_t picture;  // its number there
  std::uint64_t edit;
  bool rests;
  bool exact;
  Json handles;
};

struct PageView {
  std::uint32_t page;
  std::uint32_t number;  // the page's
  std::uint32_t link;    // the renderer's
  std::uint32_t width = 0, height = 0;
  Eye eye{};
  LineLook look{};  // As::surface: the renderer draws it
  Tool tool = Tool::none;
  RingAxes axes = RingAxes::numbers;
  GhostFrames ghosts{};
  bool marks = false;     // camera and lights are seen
  bool framed = false;    // the studio chose where the eye is, and chooses again
  bool orbiting = false;  // a hand turns it
  std::string hot{};      // the handle under the mouse

  std::uint32_t sent = 0, painted = 0;  // pictures of the page
  bool rested = true;                   // the last one sent says that it rests
  std::optional<Shown> shown{};         // of the last picture drawn, or asked for

  // Of the renderer.
  bool known = false;  // it has the view
  std::optional<Interval> interval{};
  Shot scene{};             // asked for last
  bool lost = false;        // and dropped
  bool moved = false;       // since the interval began something was in motion
  std::uint32_t begun = 0;  // the picture with which the interval begins: older ones are nothing any more
  std::optional<Asked> asked{};

  // Of lines.
  std::optional<preview::Drawing> drawing{};
  images::Image drawn{};

  bool of_surfaces() const { return look.as == preview::As::surface; }
  bool has_room() const { return sent - painted < 2; }
  // The next picture is drawn from nothing.
  void forget() {
    interval.reset();
    asked.reset();
    shown.reset();
    drawn = {};
  }
};

}  // namespace mars::studio
