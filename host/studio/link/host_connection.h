// The studio's end of the socket to a serving host (host/render/serve/serve_messages.h): it waits for the host at a
// socket that only this user can reach, sends what the host takes, and reads what it draws.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "host/render/serve/serve_messages.h"
#include "host/studio/link/renderer_link.h"

namespace boost::asio {
class io_context;
}

namespace mars::studio {

using Body = std::shared_ptr<const std::vector<std::byte>>;

class HostConnection {
 public:
  // All are called from the io_context.
  struct Listener {
    std::function<void()> connected;
    std::function<void(const serve::Ready&)> ready;
    std::function<void(SurfacePicture)> picture;
    std::function<void(std::uint32_t view, std::uint32_t picture)> dropped;
    std::function<void()> closed;  // by the host
  };

  // Throws Failure where there can be no socket.
  HostConnection(boost::asio::io_context& context, Listener listener);
  ~HostConnection();  // from then on nothing is called
  HostConnection(const HostConnection&) = delete;
  HostConnection& operator=(const HostConnection&) = delete;

  // Where the host is to connect.
  std::string path() const;

  // Once it is connected. `body` may be nullptr.
  void send(serve::Kind kind, std::uint32_t view, std::uint32_t picture, Body body);
  // Forgets what was not sent yet of a view: inbetweens, and with `scenes` its scenes too. Returns the numbers
  // of their pictures.
  std::vector<std::uint32_t> take_back(std::uint32_t view, bool scenes);

 private:
  class Wire;
  std::shared_ptr<Wire> wire_;
};

}  // namespace mars::studio
