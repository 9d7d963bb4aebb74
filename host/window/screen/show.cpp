#include "host/window/screen/show.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/socket.h>

#include <array>
#include <chrono>

#include "host/window/screen/player_show.h"
#include "host/window/screen/rendering_show.h"

namespace mars::window {
namespace {

constexpr std::chrono::milliseconds kTurn{10};  // between two looks for what a person did

// What started us, learns that there is a display, and may leave us to ourselves before it ends.
class Starter {
 public:
  Starter() : control_(kControl) { send(kControl, &kReady, 1, MSG_NOSIGNAL); }

  bool has_left() const { return left_; }
  int descriptor() const { return left_ ? -1 : control_.number(); }
  // False: it has ended, and we have to.
  bool look() {
    if (left_) return true;
    char word = 0;
    const ssize_t count = recv(control_.number(), &word, 1, MSG_DONTWAIT);
    left_ = count == 1 && word == kLeft;
    return left_ || count < 0;
  }

 private:
  child::Descriptor control_;
  bool left_ = false;
};

void wait(int one, int other) {
  std::array<pollfd, 2> sources{{{one, POLLIN, 0}, {other, POLLIN, 0}}};
  poll(sources.data(), sources.size(), static_cast<int>(kTurn.count()));
}

// Programs that SDL may start do not inherit it.
child::Descriptor connection() {
  fcntl(kConnection, F_SETFD, FD_CLOEXEC);
  fcntl(kConnection, F_SETFL, fcntl(kConnection, F_GETFL) | O_NONBLOCK);
  return child::Descriptor(kConnection);
}

void show_rendering(const std::string& film) {
  RenderingShow show(film, connection());
  Starter starter;  // only now there is a display
  while (show.handle_events() && starter.look()) {
    const bool has_host = show.receive();
    if (starter.has_left() && !has_host) show.finish();
    show.update();
    wait(starter.descriptor(), show.descriptor());
  }
}

void show_player(const std::string& film) {
  PlayerShow show(film, connection());
  for (Starter starter; show.handle_events() && starter.look();) {
    show.receive();
    show.update();
    wait(starter.descriptor(), show.descriptor());
  }
}

}  // namespace

void show(Shows shows, const std::string& title) {
  shows == Shows::rendering ? show_rendering(title) : show_player(title);
}

}  // namespace mars::window
