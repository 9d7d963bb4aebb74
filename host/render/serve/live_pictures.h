// Composes the pictures of a studio's views, and sends the studio of each where it differs from the one before.
#pragma once

#include <cstdint>
#include <list>
#include <map>
#include <vector>

#include "host/render/compositor/compositor.h"
#include "host/render/farm/engine.h"
#include "host/render/pictures/socket.h"
#include "node/wire/film.h"

namespace mars::serve {

class LivePictures : public farm::PictureTaker {
 public:
  // All nodes are there. `block`: side of the compositor's blocks, pixels.
  LivePictures(farm::Engine& engine, pictures::Socket& studio, std::uint32_t block);

  bool expects(const wire::Strip& strip, bool is_drawn) const override;
  void take_strip(farm::StripMessage strip) override;
  // Sends what the studio did not take before.
  bool compose() override;

  // Each begins a picture, of which `asked` is the studio's number; its number for nodes.

  // A keyframe, which all nodes draw. `all_moves`: in the scene; there is no saved background to keep.
  std::uint32_t begin_keyframe(std::uint32_t view, std::uint32_t asked, const wire::PackedFilm& scene, bool all_moves);
  // An inbetween, which this node draws.
  std::uint32_t begin_inbetween(std::uint32_t view, std::uint32_t asked, int node);

  bool is_known(std::uint32_t view) const { return views_.contains(view); }
  // Whether the keyframe of the view's interval is whole.
  bool has_keyframe(std::uint32_t view) const;
  // Whether nodes draw no keyframe of another view, and at most one of this view.
  bool takes_keyframe(std::uint32_t view) const;
  // What is begun of the view is wanted no more. Nodes may still draw it; what they send is pasted nowhere.
  void drop(std::uint32_t view);
  void forget(std::uint32_t view) { views_.erase(view); }
  void send_dropped(std::uint32_t view, std::uint32_t asked);

  std::uint32_t sent() const { return sent_; }  // pictures

 private:
  struct View {
    View(std::uint32_t width, std::uint32_t height, std::uint32_t block);

    std::uint32_t width, height;
    compositor::Compositor compositor;
    std::list<compositor::Frame> frames;
    std::vector<compositor::Frame*> free;  // frames to draw into; the one used last is last
    bool all_moves = false;                // in its interval
    bool has_keyframe = false;
    std::uint32_t newest = 0;  // of its pictures that the studio was sent: the studio's number
  };

  struct Picture {
    std::uint32_t view;
    std::uint32_t asked;  // its number for the studio
    wire::FrameKind kind;
    compositor::Frame* frame;  // where it is put together; nullptr: it is wanted no more
    double begun;
    int nodes_left;  // that have not sent their last strip of it
  };

  View& sized(std::uint32_t view, const wire::FilmSettings& settings);
  std::uint32_t begin(std::uint32_t view, std::uint32_t asked, wire::FrameKind kind, const collectives::Group& nodes);
  void finish(std::uint32_t number, const Picture& picture);
  void send(View& view, std::uint32_t number, const Picture& picture);

  farm::Engine& engine_;
  pictures::Socket& studio_;
  const std::uint32_t block_;
  std::map<std::uint32_t, View> views_;        // that have had a keyframe
  std::map<std::uint32_t, Picture> pictures_;  // that nodes draw, by their numbers for nodes, which ascend
  std::uint32_t last_ = 0;                     // of those
  std::uint32_t sent_ = 0;
};

}  // namespace mars::serve
