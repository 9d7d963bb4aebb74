// Which picture of which view is due, and how it is asked for: an inbetween or a new interval, from the renderer, or
// lines. The newest wins: a view whose page has no room, or whose picture is under way, is asked for when that is over.
#pragma once

#include <cstdint>
#include <functional>
#include <list>
#include <optional>
#include <string>
#include <vector>

#include "host/studio/link/renderer_link.h"
#include "host/studio/stage/line_pictures.h"
#include "host/studio/stage/moments.h"
#include "host/studio/stage/view.h"
#include "host/studio/stage/view_picture.h"

namespace mars::studio {

class Flow {
 public:
  // The view in which a gesture is under way.
  struct HandPlace {
    PageNumber page;
    std::uint32_t view;
  };
  // What pages have to do with it.
  struct Pages {
    std::function<std::uint64_t(PageNumber)> edit_of;  // its last message's
    std::function<std::optional<HandPlace>()> hand;
    std::function<Json(const PageView&)> controls;
    std::function<void(PageView&)> send_handles;
    std::function<void(const Json& message)> send_to_all;
    std::function<void(ViewPicture)> picture;
  };

  // All must outlive it.
  Flow(Project& project, RendererLink& link, Moments& moments, std::list<PageView>& views, Pages pages);

  // Asks for all that is due and has room. Callbacks of the link may come while it does.
  void serve();

  // The renderer's answers.
  void take(SurfacePicture picture);
  void drop(std::uint32_t link, std::uint32_t picture);

  PageView* view_of_link(std::uint32_t link);  // nullptr: there is none
  wire::Camera camera_of(const PageView& view) const;

 private:
  bool in_motion(const PageView& view) const;
  bool hand_is_in(const PageView& view) const;
  void follow_film();
  void serve_views();
  bool other_is_asked(const PageView& hand) const;
  void advance(PageView& view);
  void advance_lines(PageView& view, const Shown& now);
  void advance_surface(PageView& view, const Shown& now);
  bool looks_the_same(PageView& view, const Shown& now);
  bool is_own(const PageView& view) const;
  bool is_exact(const PageView& view);
  Shot scene_of(const PageView& view, const Shown& now) const;
  static std::vector<std::byte> packed(const Shot& scene, const std::vector<std::uint32_t>& moving);
  void ask(PageView& view, const Shown& now, bool rests);
  std::optional<Moved> inbetween(PageView& view, const Shot& scene, bool exact);
  std::vector<std::uint32_t> moving_of(PageView& view, const Shot& scene, bool exact);
  void send(PageView& view, const Asked& asked, std::vector<pictures::Rect> rects, std::vector<std::uint32_t> pixels);

  Project& project_;
  RendererLink& link_;
  Moments& moments_;
  LinePictures lines_;
  std::list<PageView>& views_;
  Pages pages_;
  std::uint32_t picture_ = 0;  // of all views, at the renderer
  std::uint64_t film_number_ = 0;
  std::string sent_problem_;
  bool serving_ = false, again_ = false;
};

}  // namespace mars::studio
