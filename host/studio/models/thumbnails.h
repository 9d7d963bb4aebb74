// Which models a film can have, and small pictures of them for pages (docs/studio-protocol.md, "Models"). `mars
// preview` draws a picture when a page asks for it: one at a time, in a process of its own that lets all else go
// before, and begun only while no page moves anything. It stays until the model's file changes. All calls and callbacks
// are on the thread that runs the io_context.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>

#include "host/studio/stage/stage.h"

namespace boost::asio {
class io_context;
}

namespace mars::studio {

class Thumbnails {
 public:
  struct Listener {
    std::function<void(PageNumber page, const Json& message)> tell;
  };

  virtual ~Thumbnails() = default;

  // Whether the message is for them: models or thumbnail.
  static bool is_for_it(const Json& message) { return message.at("do") == "models" || message.at("do") == "thumbnail"; }
  // Such a message. Throws Failure where it names no model of the list.
  virtual void take(PageNumber page, const Json& message) = 0;
  virtual void page_closed(PageNumber page) = 0;
  // Called a few times a second; `at_rest`: no page has moved anything since the call before.
  virtual void look(bool at_rest) = 0;
};

struct ThumbnailSettings {
  std::filesystem::path file;       // that is open: models lie beside it
  std::filesystem::path mars;       // the program
  std::filesystem::path temporary;  // where a picture lies until it is read
};

std::unique_ptr<Thumbnails> make_thumbnails(boost::asio::io_context& context, ThumbnailSettings settings,
                                            Thumbnails::Listener listener);

}  // namespace mars::studio
