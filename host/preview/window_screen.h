// A window as a player's screen, by the program that shows windows (host/window): it is sent blocks that changed, and
// sends keys. A window that shows pictures slowly gets fewer of them.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "host/child/descriptor.h"
#include "host/preview/screen.h"
#include "host/render/pictures/socket.h"
#include "host/window/window_process.h"

namespace mars::preview {

class WindowScreen : public Screen {
 public:
  // Throws Failure if there is no display. `self`: the running program's own file; `extent`: the film's.
  WindowScreen(const std::filesystem::path& self, const std::string& title, images::PictureSize extent);

  images::PictureSize space() const override { return space_; }
  bool is_ready() const override { return socket_.flushed(); }
  void show(const SharedImage& image, const Words& words) override;
  ScreenEvents wait(std::chrono::nanoseconds time) override;

 private:
  WindowScreen(const std::filesystem::path& self, const std::string& title, images::PictureSize extent,
               child::SocketPair pair);

  void send_picture(const images::Image& image);
  std::vector<compositor::Rect> changed(const images::Image& image) const;
  void send_title(const Words& words);
  void print(const Words& words);
  void take_messages(ScreenEvents& events);

  const std::string title_;
  window::WindowProcess process_;
  pictures::Socket socket_;
  images::PictureSize space_;
  SharedImage shown_;  // that the window has; nullptr: none
  Words words_;        // last shown
};

}  // namespace mars::preview
