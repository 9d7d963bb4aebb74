// A rendering of the open film that pages start, watch and stop, and the frames of a folder (docs/studio-protocol.md,
// "Rendering"). It is the same for all pages; each looks at what is drawn now, or at a finished frame. All calls and
// callbacks are on the thread that runs the io_context; nothing of it waits.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>

#include "host/studio/stage/stage.h"

namespace boost::asio {
class io_context;
}

namespace mars::studio {

// The page's number for the view that shows a rendering.
inline constexpr std::uint32_t kRenderingView = 255;

class Rendering {
 public:
  struct Listener {
    std::function<void(ViewPicture)> picture;
    std::function<void(PageNumber page, const Json& message)> tell;  // one page; Stage::kAllPages: all of them
  };

  virtual ~Rendering() = default;

  // Whether the message is for a rendering: render, stop, watch, scrub, or painted of kRenderingView.
  static bool is_for_it(const Json& message);
  // Such a message. Throws Failure where it makes no sense.
  virtual void take(PageNumber page, const Json& message) = 0;
  virtual void page_opened(PageNumber page) = 0;
  virtual void page_closed(PageNumber page) = 0;
};

struct RenderingSettings {
  std::filesystem::path film;    // its file
  std::filesystem::path folder;  // the studio's: frames and hostfiles are below it
  std::filesystem::path mars;    // the program
};

// With its end the rendering ends, which can go on later.
std::unique_ptr<Rendering> make_rendering(boost::asio::io_context& context, const RenderingSettings& settings,
                                          Rendering::Listener listener);

}  // namespace mars::studio
