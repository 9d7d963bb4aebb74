// All views of all pages: what each shows, which picture of it is due, and what a hand does in it. Surfaces come from
// the renderer, sticks, control vertices and prisms from mars::preview. Newest wins: a view asks for a picture only
// while its page has room (at most 2 pictures that are not painted yet), and then of what is there by then.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "host/render/serve/serve_messages.h"
#include "host/studio/link/renderer_link.h"
#include "host/studio/project/project.h"

namespace mars::studio {

using PageNumber = std::uint32_t;

// For a page, of one of its views: rectangles that changed since its picture before.
struct ViewPicture {
  PageNumber page = 0;
  std::uint32_t view = 0;     // the page's number for it
  std::uint32_t picture = 0;  // 1, 2, ... of this view, without gaps
  std::uint64_t edit = 0;     // the last of the page's messages that it shows
  std::uint16_t width = 0, height = 0;
  bool rests = true;  // false: more changes are to be expected at once (a hand moves); it may be lossy then
  bool exact = true;  // the film's own pixels; false: lines, other eyes, what moves
  std::vector<serve::Rect> rects;
  std::vector<std::uint32_t> pixels;  // as SurfacePicture's
  Json handles;                       // of the view, to be shown with it (docs/studio-protocol.md)
};

class Stage {
 public:
  struct Listener {
    std::function<void(ViewPicture)> picture;
    std::function<void(PageNumber page, const Json& message)> tell;  // one page; kAllPages: all of them
  };
  static constexpr PageNumber kAllPages = 0;

  virtual ~Stage() = default;

  // A page's message that concerns views or hands: view, orbit, unview, painted, grab, drag, drop, let_go, hover,
  // select. Of messages that the project has obeyed, such as preview, commit, undo and frame, it notes the number of
  // the edit alone. Throws Failure where it makes no sense.
  virtual void take(PageNumber page, const Json& message) = 0;
  virtual void page_closed(PageNumber page) = 0;

  // film() may have changed: views that show it are drawn as they have room.
  virtual void project_changed() = 0;

  // The renderer's callbacks.
  virtual void take_surface(SurfacePicture picture) = 0;
  virtual void surface_dropped(std::uint32_t view, std::uint32_t picture) = 0;
};

// All must outlive it, and it does all on the thread that calls it.
std::unique_ptr<Stage> make_stage(Project& project, RendererLink& link, Stage::Listener listener);

}  // namespace mars::studio
