// What a connection of the server is to it, and it to them.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string_view>

#include "host/studio/web/gate.h"
#include "host/studio/web/pages.h"
#include "host/studio/web/patience.h"

namespace mars::web {

// Where files are uploaded: /import/IMPORT/FILE, by their numbers.
inline constexpr std::string_view kUploads = "/import/";

// A page's WebSocket.
class PageSocket {
 public:
  virtual ~PageSocket() = default;
  virtual void tell(const Json& message) = 0;
  virtual void show(studio::ViewPicture picture) = 0;
  virtual void close() = 0;

  // Pings its browser; whether anything came since then; ends it without a close frame, which it would not answer.
  virtual void ask() = 0;
  virtual bool was_heard_since(std::chrono::steady_clock::time_point then) const = 0;
  virtual void drop() = 0;
};

// A page that is to be, for which there is no room.
class Newcomer {
 public:
  virtual ~Newcomer() = default;
  virtual void answer(bool has_room) = 0;
};

// What connections need of the server, which outlives them.
class Site {
 public:
  virtual ~Site() = default;
  virtual const Gate& gate() const = 0;
  virtual const std::filesystem::path& folder() const = 0;
  virtual const Patience& patience() const = 0;
  virtual bool has_room() const = 0;  // for another page
  // Answers once pages that do not answer have given way; at once where a later one waits.
  virtual void wait_for_room(std::shared_ptr<Newcomer> newcomer) = 0;
  virtual PageNumber enter(std::shared_ptr<PageSocket> page) = 0;
  virtual void received(PageNumber page, const Json& message) = 0;
  virtual void left(PageNumber page) = 0;
  // Of a request's path, "/import/3/0", with a body of this many bytes. Throws Failure where nothing waits for it.
  virtual std::unique_ptr<studio::Upload> begin_upload(std::string_view path, std::uint64_t bytes) = 0;
};

}  // namespace mars::web
