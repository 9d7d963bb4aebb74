// The studio's end of a watched rendering: a socket that only this user can reach, at which hosts say what they draw
// (host/render/watch/watch_messages.h), one after another.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "host/render/watch/watch_messages.h"

namespace boost::asio {
class io_context;
}

namespace mars::studio {

struct WatchedUpdate {
  watch::PictureHead head{};
  std::vector<watch::Rect> rects;
  std::vector<watch::Line> lines;
  std::vector<std::uint32_t> pixels;
};

class WatchConnection {
 public:
  // All are called from the io_context.
  struct Listener {
    std::function<void(const watch::Begin&, std::vector<watch::Node>)> begin;
    std::function<void(const WatchedUpdate&)> picture;
    std::function<void(const watch::DrawnHead&, std::vector<watch::Part>)> drawn;
  };

  // Throws Failure where there can be no socket.
  WatchConnection(boost::asio::io_context& context, Listener listener);
  ~WatchConnection();  // from then on nothing is called
  WatchConnection(const WatchConnection&) = delete;
  WatchConnection& operator=(const WatchConnection&) = delete;

  std::string path() const;

 private:
  class Wire;
  std::shared_ptr<Wire> wire_;
};

}  // namespace mars::studio
