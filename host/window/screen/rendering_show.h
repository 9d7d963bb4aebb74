// Shows a rendering: what its hosts send, one host after another, as a watcher gets it. Its keys change how it is
// shown.
#pragma once

#include <deque>
#include <optional>
#include <string>

#include "host/child/descriptor.h"
#include "host/render/pictures/socket.h"
#include "host/window/screen/screen.h"

namespace mars::window {

class RenderingShow {
 public:
  // `listener`: a socket that listens.
  RenderingShow(std::string film, child::Descriptor listener);

  // False: a person has closed the window.
  bool handle_events();
  // False: no host is there.
  bool receive();
  void update() { screen_.update(); }
  // The rendering has ended well: no host will come any more.
  void finish();
  // Whether a person sees it: since the first host came.
  bool is_open() const { return screen_.is_open(); }
  // What says that there is something to receive; -1: nothing does.
  int descriptor() const;

 private:
  bool handle_key(const pictures::Key& key);
  void accept();
  void take(const pictures::Message& message);
  void note_drawn(double seconds);
  std::string title() const;

  const std::string film_;
  child::Descriptor listener_;
  std::optional<pictures::Socket> host_;
  std::optional<pictures::Begin> begin_;  // of the host
  Screen screen_;
  std::uint32_t frame_ = 0;     // that is shown
  std::uint32_t drawn_ = 0;     // frames, by this host
  std::deque<double> seconds_;  // when the last ones were whole, since the host's first command
  bool finished_ = false;
};

}  // namespace mars::window
