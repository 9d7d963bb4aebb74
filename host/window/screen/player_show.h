// Shows what a player sends, and sends the player the keys that a person presses and the space that the window has.
#pragma once

#include <optional>
#include <string>

#include "host/child/descriptor.h"
#include "host/render/pictures/socket.h"
#include "host/window/screen/screen.h"

namespace mars::window {

class PlayerShow {
 public:
  PlayerShow(std::string film, child::Descriptor player);

  // False: a person has closed the window, or the player has ended.
  bool handle_events();
  void receive();
  void update() { screen_.update(); }
  int descriptor() const { return player_.descriptor(); }

 private:
  void take(const pictures::Message& message);
  void send_space();

  const std::string film_;
  pictures::Socket player_;
  std::optional<pictures::Begin> begin_;
  Screen screen_;
  images::PictureSize space_{0, 0};  // that the player knows
};

}  // namespace mars::window
