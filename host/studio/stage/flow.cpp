#include "host/studio/stage/flow.h"

#include <algorithm>
#include <utility>

#include "node/wire/scene.h"

namespace mars::studio {

Flow::Flow(Project& project, RendererLink& link, Moments& moments, std::list<PageView>& views, Pages pages)
    : project_(project),
      link_(link),
      moments_(moments),
      lines_(project, moments),
      views_(views),
      pages_(std::move(pages)) {}

void Flow::take(SurfacePicture picture) {
  PageView* const view = view_of_link(picture.view);
  if (view == nullptr || !view->of_surfaces() || picture.picture < view->begun || picture.head.width != view->width ||
      picture.head.height != view->height)
    return;
  const bool expected = view->asked && view->asked->picture == picture.picture;
  Asked asked =
      expected ? std::move(*view->asked)
               : Asked{picture.picture, pages_.edit_of(view->page), !in_motion(*view), false, pages_.controls(*view)};
  if (expected) view->asked.reset();
  send(*view, asked, std::move(picture.rects), std::move(picture.pixels));
  serve();
}

// An inbetween that was dropped is asked for again, as it is by then; a keyframe leaves no interval.
void Flow::drop(std::uint32_t link, std::uint32_t picture) {
  PageView* const view = view_of_link(link);
  if (view == nullptr || !view->asked || view->asked->picture != picture) return;
  if (picture == view->begun) view->interval.reset();
  view->asked.reset();
  view->shown.reset();
  view->lost = true;
  serve();
}

PageView* Flow::view_of_link(std::uint32_t link) {
  const auto found =
      std::find_if(views_.begin(), views_.end(), [&](const PageView& view) { return view.link == link; });
  return found == views_.end() ? nullptr : &*found;
}

wire::Camera Flow::camera_of(const PageView& view) const {
  const wire::FilmData& now = moments_.now();
  const wire::Camera& own = now.cameras.front();
  return view.eye.from == From::camera ? own : camera_from(view.eye, own.exposure);
}

bool Flow::in_motion(const PageView& view) const { return pages_.hand() || project_.in_gesture() || view.orbiting; }

bool Flow::hand_is_in(const PageView& view) const {
  const auto hand = pages_.hand();
  return view.orbiting || (hand && hand->page == view.page && hand->view == view.number);
}

void Flow::serve() {
  if (serving_) {
    again_ = true;
    return;
  }
  serving_ = true;
  try {
    do {
      again_ = false;
      follow_film();
      if (moments_.show_the_film()) serve_views();
    } while (again_);
  } catch (...) {
    serving_ = false;
    throw;
  }
  serving_ = false;
}

void Flow::follow_film() {
  moments_.renew();
  if (moments_.problem() != sent_problem_) {
    sent_problem_ = moments_.problem();
    if (!sent_problem_.empty()) pages_.send_to_all({{"is", "remark"}, {"text", sent_problem_}});
  }
  if (moments_.film_number() == film_number_) return;
  film_number_ = moments_.film_number();
  link_.set_film(moments_.film_block());
  for (PageView& view : views_) {
    view.known = false;
    view.forget();
  }
}

// The view under the hand first; of the others, while it moves, one at a time.
void Flow::serve_views() {
  const auto hand = std::find_if(views_.begin(), views_.end(), [&](const PageView& v) { return hand_is_in(v); });
  if (hand != views_.end()) advance(*hand);
  for (PageView& view : views_) {
    if (hand != views_.end() && &view == &*hand) continue;
    if (hand != views_.end() && view.of_surfaces() && other_is_asked(*hand)) continue;
    advance(view);
  }
  // Who waited longest comes first.
  if (hand != views_.end() && views_.size() > 2) {
    const auto first = std::find_if(views_.begin(), views_.end(),
                                    [&](const PageView& v) { return &v != &*hand && v.asked.has_value(); });
    if (first != views_.end()) views_.splice(views_.end(), views_, first);
  }
}

bool Flow::other_is_asked(const PageView& hand) const {
  return std::any_of(views_.begin(), views_.end(),
                     [&](const PageView& view) { return &view != &hand && view.asked.has_value(); });
}

void Flow::advance(PageView& view) {
  if (!view.has_room()) return;
  const Shown now{moments_.number(), camera_of(view)};
  view.of_surfaces() ? advance_surface(view, now) : advance_lines(view, now);
}

void Flow::advance_lines(PageView& view, const Shown& now) {
  const bool rests = !in_motion(view);
  if (view.shown == now && (view.rested || !rests)) return;
  if (!view.drawing || view.drawing->image().width != view.width || view.drawing->image().height != view.height)
    view.drawing.emplace(view.width, view.height);
  if (view.shown != now) lines_.draw(view.look, now.camera, *view.drawing);
  const images::Image& image = view.drawing->image();
  std::vector<pictures::Rect> rects = changed_rects(view.drawn, image);
  std::vector<std::uint32_t> pixels = pictures::cut_opaque(image.pixels, image.width, rects);
  view.drawn = image;
  view.shown = now;
  send(view, {0, pages_.edit_of(view.page), rests, false, pages_.controls(view)}, std::move(rects), std::move(pixels));
}

void Flow::advance_surface(PageView& view, const Shown& now) {
  const bool rests = !in_motion(view);
  if (view.asked) {
    // A hand does not wait for a picture that shows what stood still before it came.
    if (rests || !view.asked->rests || view.shown == now) return;
    view.interval.reset();
    view.asked.reset();
  }
  if (view.shown != now && !looks_the_same(view, now)) return ask(view, now, rests);
  if (!rests) return;
  if (is_own(view) && !is_exact(view) && moments_.own_moving()) return ask(view, now, rests);
  if (!view.rested) send(view, {0, pages_.edit_of(view.page), true, is_exact(view), pages_.controls(view)}, {}, {});
}

// What changed may be seen in controls alone.
bool Flow::looks_the_same(PageView& view, const Shown& now) {
  if (!view.interval || view.lost || !same_picture(view.scene, scene_of(view, now))) return false;
  view.shown = now;
  if (view.rested) pages_.send_handles(view);
  return true;
}

// Whether it shows what `mars render` would.
bool Flow::is_own(const PageView& view) const {
  const wire::FilmSettings& settings = moments_.now().settings;
  return view.eye.from == From::camera && view.width == settings.width && view.height == settings.height &&
         settings.pixel_aspect == 1;
}

bool Flow::is_exact(const PageView& view) {
  if (!is_own(view) || !view.interval) return false;
  const auto own = moments_.own_moving();
  return own && std::equal(own->begin(), own->end(), view.interval->moving().begin(), view.interval->moving().end());
}

Shot Flow::scene_of(const PageView& view, const Shown& now) const {
  return {moments_.shared_now(), now.camera, view.width, view.height};
}

// As nodes take it.
std::vector<std::byte> Flow::packed(const Shot& scene, const std::vector<std::uint32_t>& moving) {
  wire::FilmData film = *scene.moment;
  film.cameras = {scene.camera};
  film.settings.width = scene.width;
  film.settings.height = scene.height;
  film.settings.pixel_aspect = 1;  // views show square pixels, as many across as make them as wide
  film.moving = moving;
  film.intervals = {{0, 1, 0, static_cast<std::uint32_t>(moving.size())}};
  return wire::pack_scene(film);
}

// Why a picture that rests must have the film's own interval: docs/exactness.md, "Where intervals are cut".
void Flow::ask(PageView& view, const Shown& now, bool rests) {
  Shot scene = scene_of(view, now);
  const bool exact = rests && is_own(view) && moments_.own_moving().has_value();
  Asked asked{++picture_, pages_.edit_of(view.page), rests, exact, pages_.controls(view)};
  view.shown = now;
  view.lost = false;
  const std::uint32_t picture = picture_;
  if (const auto moved = inbetween(view, scene, exact)) {
    view.asked = std::move(asked);
    view.scene = std::move(scene);
    view.moved = view.moved || !rests;
    link_.draw(view.link, picture, moved->segments, moved->patches);
    return;
  }
  std::vector<std::uint32_t> moving = moving_of(view, scene, exact);
  std::vector<std::byte> block = packed(scene, moving);
  view.scene = scene;
  view.interval.emplace(std::move(scene), std::move(moving));
  view.begun = picture;
  view.moved = !rests;
  view.known = true;
  view.asked = std::move(asked);
  link_.begin(view.link, picture, std::move(block));
}

// What an inbetween must move; none: a new interval begins.
std::optional<Moved> Flow::inbetween(PageView& view, const Shot& scene, bool exact) {
  if (!view.interval || (exact && !is_exact(view))) return std::nullopt;
  if (view.interval->alone() && !exact) return std::nullopt;
  auto moved = view.interval->moved_to(scene);
  if (!moved || !view.interval->holds(*moved)) return std::nullopt;
  return moved;
}

// What changes now, and what did since something is in motion.
std::vector<std::uint32_t> Flow::moving_of(PageView& view, const Shot& scene, bool exact) {
  if (exact) {
    const auto own = *moments_.own_moving();
    return {own.begin(), own.end()};
  }
  if (!view.interval) return {};
  std::vector<std::uint32_t> changed = changed_parts(view.scene, scene);
  const wire::FilmData &before = *view.scene.moment, &after = *scene.moment;
  const bool same_numbers =
      before.segments.size() == after.segments.size() && before.bones.size() == after.bones.size();
  if (view.moved && !view.interval->alone() && same_numbers) return joined(changed, view.interval->moving());
  return changed;
}

void Flow::send(PageView& view, const Asked& asked, std::vector<pictures::Rect> rects,
                std::vector<std::uint32_t> pixels) {
  view.rested = asked.rests;
  ViewPicture picture;
  picture.page = view.page;
  picture.view = view.number;
  picture.picture = ++view.sent;
  picture.edit = asked.edit;
  picture.width = static_cast<std::uint16_t>(view.width);
  picture.height = static_cast<std::uint16_t>(view.height);
  picture.rests = asked.rests;
  picture.exact = asked.exact;
  picture.rects = std::move(rects);
  picture.pixels = std::move(pixels);
  picture.handles = asked.handles;
  pages_.picture(std::move(picture));
}

}  // namespace mars::studio
