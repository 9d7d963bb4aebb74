// The program that shows pictures in a window (host/window/screen), in a process of its own: it alone knows the
// display, whose end ends that process and no other.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "host/child/descriptor.h"
#include "host/child/process.h"

namespace mars::window {

// What the program's words say it shows, and what its descriptor kConnection is.
enum class Shows {
  rendering,  // a listening socket, to which hosts connect one after another
  player,     // a connected socket
};

inline constexpr const char* kProgram = "mars-window";
inline constexpr const char* kRendering = "rendering";  // words for the program, before the title
inline constexpr const char* kPlayer = "player";
inline constexpr int kControl = 0;     // descriptor of a socket: the program says there whether it has a display
inline constexpr int kConnection = 3;  // descriptor
inline constexpr char kReady = 'r';    // all that the program says if it has one; else why not, and a line of remedy
inline constexpr char kLeft = 'l';     // to the program: it goes on when its starter has ended

// None: MARS was built or installed without windows. `self`: the running program's own file.
std::optional<std::filesystem::path> find_program(const std::filesystem::path& self);

class WindowProcess {
 public:
  // Returns when the program has a display. Throws Failure if it has none, or is not there. `title`: the film's name.
  WindowProcess(const std::filesystem::path& self, Shows shows, const std::string& title,
                const child::Descriptor& connection);

  // The window stays until a person closes it. Otherwise it ends with this.
  void leave();

 private:
  child::SocketPair control_;
  child::Process process_;
};

}  // namespace mars::window
