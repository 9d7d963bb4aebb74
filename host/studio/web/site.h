// What a connection of the server is to it, and it to them.
#pragma once

#include <filesystem>
#include <memory>

#include "host/studio/web/gate.h"
#include "host/studio/web/pages.h"

namespace mars::web {

// A page's WebSocket.
class PageSocket {
 public:
  virtual ~PageSocket() = default;
  virtual void tell(const Json& message) = 0;
  virtual void show(studio::ViewPicture picture) = 0;
  virtual void close() = 0;
};

// What connections need of the server, which outlives them.
class Site {
 public:
  virtual ~Site() = default;
  virtual const Gate& gate() const = 0;
  virtual const std::filesystem::path& folder() const = 0;
  virtual bool has_room() const = 0;  // for another page
  virtual PageNumber enter(std::shared_ptr<PageSocket> page) = 0;
  virtual void said(PageNumber page, const Json& message) = 0;
  virtual void left(PageNumber page) = 0;
};

}  // namespace mars::web
