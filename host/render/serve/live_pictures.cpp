#include "host/render/serve/live_pictures.h"

#include <algorithm>
#include <utility>

#include "hal/nx/nx_messages.h"
#include "host/render/compositor/rectangles.h"
#include "host/render/farm/assembly.h"

namespace mars::serve {

using pictures::Kind;

LivePictures::View::View(std::uint32_t width, std::uint32_t height, std::uint32_t block)
    : width(width), height(height), compositor(width, height, block) {}

LivePictures::LivePictures(farm::Engine& engine, pictures::Socket& studio, std::uint32_t block)
    : engine_(engine), studio_(studio), block_(block) {}

bool LivePictures::compose() {
  studio_.flush();
  return false;
}

// Frames stay where the size does.
LivePictures::View& LivePictures::sized(std::uint32_t view, const wire::FilmSettings& settings) {
  auto known = views_.find(view);
  const bool fits =
      known != views_.end() && known->second.width == settings.width && known->second.height == settings.height;
  if (fits) return known->second;
  views_.erase(view);
  return views_.emplace(view, View(settings.width, settings.height, block_)).first->second;
}

// The interval before is undone; its keyframe may not be whole.
std::uint32_t LivePictures::begin_keyframe(std::uint32_t view, std::uint32_t asked, const wire::PackedFilm& scene,
                                           bool all_moves) {
  View& of = sized(view, scene.settings());
  of.compositor.begin_interval(farm::background_pixel(scene, scene.intervals().front(), wire::PixelFormat::rgb8));
  of.all_moves = all_moves;
  of.has_keyframe = false;
  return begin(view, asked, wire::FrameKind::keyframe, engine_.all());
}

std::uint32_t LivePictures::begin_inbetween(std::uint32_t view, std::uint32_t asked, int node) {
  return begin(view, asked, wire::FrameKind::inbetween, {node, 1});
}

std::uint32_t LivePictures::begin(std::uint32_t view, std::uint32_t asked, wire::FrameKind kind,
                                  const collectives::Group& nodes) {
  View& of = views_.at(view);
  if (of.free.empty()) of.free.push_back(&of.frames.emplace_back(of.width, of.height, block_));
  compositor::Frame* const frame = of.free.back();
  of.free.pop_back();
  of.compositor.begin_frame(*frame);
  pictures_[++last_] = {view, asked, kind, frame, dclock(), nodes.count};
  for (int node = nodes.first; node < nodes.first + nodes.count; ++node)
    engine_.assignments().give(node, {last_, view, kind});
  return last_;
}

bool LivePictures::takes_keyframe(std::uint32_t view) const {
  int of_view = 0;
  return std::ranges::none_of(pictures_, [&](const auto& each) {
    return each.second.kind == wire::FrameKind::keyframe && (each.second.view != view || ++of_view > 1);
  });
}

bool LivePictures::has_keyframe(std::uint32_t view) const {
  const auto known = views_.find(view);
  return known != views_.end() && known->second.has_keyframe;
}

// Only of a picture that is wanted no more, lines may be left out.
bool LivePictures::expects(const wire::Strip& strip, bool is_drawn) const {
  return !is_drawn && (strip.cut == 0 || pictures_.at(strip.frame).frame == nullptr);
}

void LivePictures::take_strip(farm::StripMessage strip) {
  const wire::Strip header = strip.header();
  const auto found = pictures_.find(header.frame);
  Picture& picture = found->second;
  if (picture.frame != nullptr) {
    View& view = views_.at(picture.view);
    farm::paste_strip(strip, *picture.frame, view.compositor, view.all_moves);
  }
  engine_.give(strip.slot());
  engine_.store().give_back(strip.release());
  if (header.last == 0 || --picture.nodes_left > 0) return;
  if (picture.frame != nullptr) finish(header.frame, picture);
  pictures_.erase(found);
}

// All strips came. Where a newer one was quicker, it is needed no more.
void LivePictures::finish(std::uint32_t number, const Picture& picture) {
  View& view = views_.at(picture.view);
  if (picture.kind == wire::FrameKind::keyframe) view.has_keyframe = true;
  view.free.push_back(picture.frame);
  picture.asked > view.newest ? send(view, number, picture) : send_dropped(picture.view, picture.asked);
}

void LivePictures::send(View& view, std::uint32_t number, const Picture& picture) {
  compositor::Frame& frame = *picture.frame;
  view.compositor.finish_frame(frame, number);
  view.compositor.restore(frame);
  pictures::Picture shown;
  shown.head.width = view.width;
  shown.head.height = view.height;
  shown.head.whole = 1;
  shown.head.kind = picture.kind;
  shown.rects = compositor::rectangles_of(frame.changed, view.width, view.height);
  shown.pixels = pictures::cut_opaque(frame.pixels, view.width, shown.rects);
  shown.head.seconds = dclock() - picture.begun;
  view.newest = picture.asked;
  ++sent_;
  studio_.send({Kind::picture, picture.view, picture.asked}, body_of_picture(shown));
}

void LivePictures::send_dropped(std::uint32_t view, std::uint32_t asked) { studio_.send({Kind::dropped, view, asked}); }

void LivePictures::drop(std::uint32_t view) {
  for (auto& [number, picture] : pictures_) {
    if (picture.view != view || picture.frame == nullptr) continue;
    views_.at(view).free.push_back(std::exchange(picture.frame, nullptr));
    send_dropped(view, picture.asked);
  }
}

}  // namespace mars::serve
