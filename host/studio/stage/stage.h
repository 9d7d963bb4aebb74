// All views of all pages: what each shows, which picture of it is due, and what a hand does in it. Surfaces come from
// the renderer, sticks, control vertices and prisms from mars::preview. Newest wins: a view asks for a picture only
// while its page has room (at most 2 pictures that are not painted yet), and then of what is there by then.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "host/studio/link/renderer_link.h"
#include "host/studio/project/project.h"
#include "host/studio/stage/view_picture.h"

namespace mars::studio {

class Stage {
 public:
  struct Listener {
    std::function<void(ViewPicture)> picture;
    std::function<void(PageNumber page, const Json& message)> tell;  // one page; kAllPages: all of them
  };
  static constexpr PageNumber kAllPages = 0;

  virtual ~Stage() = default;

  // A page's message that concerns views or hands: view, orbit, unview, painted, grab, drag, drop, let_go, hover,
  // select. Of messages that the project has executed, such as preview, commit, undo and frame, it notes the number of
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
