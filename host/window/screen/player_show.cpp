#include "host/window/screen/player_show.h"

#include <utility>

namespace mars::window {

using pictures::Kind;

PlayerShow::PlayerShow(std::string film, child::Descriptor player)
    : film_(std::move(film)), player_(std::move(player), pictures::Peer::host) {}

bool PlayerShow::handle_events() {
  for (const Event& event : screen_.events()) {
    if (std::holds_alternative<Closed>(event)) return false;
    if (const auto* key = std::get_if<pictures::Key>(&event)) player_.send({Kind::key}, pictures::body_of(*key));
  }
  send_space();
  return player_.is_open();
}

void PlayerShow::receive() {
  while (const auto message = player_.receive()) take(*message);
}

void PlayerShow::take(const pictures::Message& message) {
  if (message.head.kind == Kind::begin) {
    begin_ = pictures::read_begin(message).begin;
    screen_.begin(film_, {begin_->width, begin_->height});
    send_space();
  } else if (message.head.kind == Kind::picture) {
    screen_.paste(pictures::read_picture(message, begin_));
  } else if (message.head.kind == Kind::caption) {
    screen_.set_title(pictures::read_caption(message));
  }
}

void PlayerShow::send_space() {
  const images::PictureSize space = screen_.canvas().size();
  if (!screen_.is_open() || space == space_) return;
  space_ = space;
  player_.send({Kind::space}, pictures::body_of(pictures::Space{space.width, space.height}));
}

}  // namespace mars::window
