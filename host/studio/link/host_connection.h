// The studio's end of the socket to a host that sends pictures (host/render/pictures/messages.h): it waits for hosts,
// one after another, at a socket that only this user can reach, sends what the host takes, and reads what it draws.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "host/render/pictures/reading.h"

namespace boost::asio {
class io_context;
}

namespace mars::studio {

class HostConnection {
 public:
  // All are called from the io_context.
  struct Listener {
    std::function<void()> connected;
    std::function<void(pictures::BeginMessage)> begin;
    std::function<void(pictures::Picture)> picture;
    std::function<void(std::uint32_t view, std::uint32_t picture)> dropped;
    std::function<void(pictures::DrawnMessage)> drawn;
    std::function<void(const std::string& reason)> closed;  // by the host: ""; or what it sends makes no sense
  };

  // Throws Failure where there can be no socket.
  HostConnection(boost::asio::io_context& context, Listener listener);
  ~HostConnection();  // from then on nothing is called
  HostConnection(const HostConnection&) = delete;
  HostConnection& operator=(const HostConnection&) = delete;

  // Where the host is to connect.
  std::string path() const;
  // From now on no other host can connect, and the name is gone.
  void close_to_others();

  // Once it is connected. `body` may be nullptr.
  void send(pictures::Kind kind, std::uint32_t view, std::uint32_t picture, pictures::Body body);
  // Forgets what was not sent yet of a view: inbetweens, and with `scenes` its scenes too. Returns the numbers
  // of their pictures.
  std::vector<std::uint32_t> take_back(std::uint32_t view, bool scenes);

 private:
  class Wire;
  std::shared_ptr<Wire> wire_;
};

}  // namespace mars::studio
