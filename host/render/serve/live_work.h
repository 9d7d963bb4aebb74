// Gives nodes what a studio requests over its socket (host/render/pictures/messages.h): each scene to all of them, each
// inbetween to one that is idle. What is newer replaces what is older of the same view and has not begun.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "host/render/farm/engine.h"
#include "host/render/pictures/socket.h"
#include "host/render/serve/live_pictures.h"
#include "node/wire/film.h"
#include "node/wire/scene.h"

namespace mars::serve {

class LiveWork : public farm::WorkGiver {
 public:
  LiveWork(farm::Engine& engine, pictures::Socket& studio, LivePictures& pictures, wire::Mapping mapping,
           std::uint32_t block)
      : engine_(engine), studio_(studio), pictures_(pictures), mapping_(mapping), block_(block) {}

  bool goes_on() const override { return studio_.is_open(); }
  bool give_work() override;
  void rest() override;

 private:
  using Request = pictures::Message;

  struct View {
    std::optional<Request> scene;              // requested, and has not begun
    std::optional<Request> draw;               // the newest; of that scene, if there is one
    std::vector<std::byte> block;              // the interval's scene
    std::optional<wire::PackedFilm> interval;  // it, read
    wire::MovingParts moving;                  // of it
  };

  bool take_requests();
  void take(Request request);
  void take_film(Request request);
  void close(std::uint32_t number);
  void drop_waiting(std::uint32_t number, std::optional<Request>& request);
  void drop_all(std::uint32_t number, View& view);

  bool give();
  void load_film();
  bool give_scene();
  bool give_draw();
  void begin_scene(std::uint32_t number, View& view);
  void begin_draw(std::uint32_t number, View& view, int node);

  farm::Engine& engine_;
  pictures::Socket& studio_;
  LivePictures& pictures_;
  const wire::Mapping mapping_;
  const std::uint32_t block_;
  std::optional<Request> next_film_;  // requested, and waits until nothing is drawn
  std::vector<std::byte> film_block_;
  std::optional<wire::PackedFilm> film_;  // that nodes have
  std::uint64_t still_memory_ = 0;        // of a node, for a view
  std::uint64_t shadow_memory_ = 0;       // and for shadows
  std::map<std::uint32_t, View> views_;
  std::uint32_t requested_ = 0;  // the last picture
  std::size_t turn_ = 0;         // the node that is asked next whether it is idle
};

}  // namespace mars::serve
