#include "host/window/screen/show.h"

#include <fcntl.h>
#include <poll.h>

#include <chrono>

#include "host/window/screen/player_show.h"
#include "host/window/screen/rendering_show.h"

namespace mars::window {
namespace {

constexpr std::chrono::milliseconds kTurn{10};  // between two looks for what a person did

void wait_for(int connection) {
  pollfd source{connection, POLLIN, 0};
  poll(&source, 1, static_cast<int>(kTurn.count()));
}

// Programs that SDL may start do not inherit it.
child::Descriptor connection() {
  fcntl(kConnection, F_SETFD, FD_CLOEXEC);
  fcntl(kConnection, F_SETFL, fcntl(kConnection, F_GETFL) | O_NONBLOCK);
  return child::Descriptor(kConnection);
}

void show_rendering(Starter& starter, const std::string& film) {
  RenderingShow show(film, connection());
  starter.send_ready();
  while (show.handle_events()) {
    const bool has_left = starter.has_left();  // before what it has left is received
    if (!show.receive() && has_left) {
      if (!show.is_open()) return;  // no host ever came
      show.finish();
    }
    show.update();
    wait_for(show.descriptor());
  }
}

void show_player(Starter& starter, const std::string& film) {
  PlayerShow show(film, connection());
  starter.send_ready();
  while (show.handle_events()) {
    show.receive();
    show.update();
    wait_for(show.descriptor());
  }
}

}  // namespace

void show(Starter& starter, Shows shows, const std::string& title) {
  shows == Shows::rendering ? show_rendering(starter, title) : show_player(starter, title);
}

}  // namespace mars::window
