// A window in which a person sees the frames of a rendering as they end (docs/window.md): a watcher of its host, which
// knows nothing else of it.
#pragma once

#include <filesystem>
#include <string>

#include "host/child/descriptor.h"
#include "host/child/private_folder.h"
#include "host/window/window_process.h"

namespace mars::launch {

class RenderingWindow {
 public:
  // Returns when the display can show it. Throws Failure if it cannot. `self`: the running program's own file.
  RenderingWindow(const std::filesystem::path& self, const std::string& film);

  // For hosts that run on this machine.
  std::string socket() const { return folder_.socket().string(); }

  // The rendering has ended well: a person closes the window.
  void leave() { process_.leave(); }

 private:
  child::PrivateFolder folder_{"mars-window", "watcher"};
  child::Descriptor listener_;
  window::WindowProcess process_;
};

}  // namespace mars::launch
