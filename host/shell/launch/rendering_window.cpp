#include "host/shell/launch/rendering_window.h"

#include "host/render/pictures/socket.h"

namespace mars::launch {

// Only the window's program keeps the socket open, so that hosts see when it has ended.
RenderingWindow::RenderingWindow(const std::filesystem::path& self, const std::string& film)
    : listener_(pictures::listen_at(socket())),
      process_(self, window::Shows::rendering, std::filesystem::path(film).filename().string(), listener_) {
  listener_.close();
}

}  // namespace mars::launch
