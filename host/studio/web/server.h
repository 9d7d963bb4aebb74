// The studio's server: the page's files by HTTP, and a WebSocket for each page. All of it runs on the thread that runs
// the io_context. Connections that are slow or silent are ended, and give way to others where they are too many: 64, of
// which 16 may be pages. A page stays as long as its browser answers pings.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "host/studio/web/pages.h"
#include "host/studio/web/patience.h"

namespace boost::asio {
class io_context;
}

namespace mars::web {

struct ServerSettings {
  std::string address = "127.0.0.1";
  std::uint16_t port = 0;   // 0: any that is free
  bool may_choose = false;  // where the port is taken, another one
  std::string certificate;  // PEM files; "": no TLS
  std::string key;
  std::filesystem::path folder;  // of the page's files
  Patience patience;
};

class Server : public Pages {
 public:
  // What a person opens, with the token.
  virtual std::string link() const = 0;
  // Ends all connections, pages' with a close frame. A page that takes none is not waited for longer than a moment.
  virtual void close() = 0;
};

// Listens when it returns. Throws Failure.
std::unique_ptr<Server> make_server(boost::asio::io_context& context, const ServerSettings& settings,
                                    PageListener listener);

}  // namespace mars::web
