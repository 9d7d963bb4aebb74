#include "host/window/window_process.h"

#include <poll.h>
#include <signal.h>
#include <sys/socket.h>

#include <array>
#include <chrono>
#include <optional>

#include "hal/failure/failure.h"
#include "host/child/environment.h"
#include "host/child/programs.h"

namespace mars::window {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::seconds kPatience{20};  // with a display, which may be far away
constexpr const char* kOtherWays = "leave out --window, or look at the film in a browser: mars studio";

std::filesystem::path program_beside(const std::filesystem::path& self) {
  if (const auto program = find_program(self)) return *program;
  throw Failure("this MARS has no windows: mars-window is not there", "",
                "install the package mars-window, or run ./bootstrap, which installs SDL 2 (Debian: libsdl2-dev) and "
                "builds it; or leave out --window");
}

child::Command command_for(const std::filesystem::path& self, Shows shows, const std::string& title) {
  return {{}, {program_beside(self).string(), shows == Shows::rendering ? kRendering : kPlayer, title}};
}

child::ProcessSetup setup_of(const child::Descriptor& control, const child::Descriptor& connection,
                             const child::Descriptor& nothing) {
  return {.streams = {{kControl, control.number()},
                      {1, nothing.number()},
                      {2, nothing.number()},
                      {kConnection, connection.number()}},
          .own_group = true,
          .default_signals = {SIGINT, SIGTERM, SIGHUP}};
}

// All that comes until the program ends; none: it does neither end nor speak in time.
std::optional<std::string> answer_of(const child::Descriptor& control) {
  std::string answer;
  for (const auto last = Clock::now() + kPatience; answer.empty() || answer.front() != kReady;) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(last - Clock::now()).count();
    pollfd speaks{control.number(), POLLIN, 0};
    if (left <= 0) return std::nullopt;
    if (poll(&speaks, 1, static_cast<int>(left)) <= 0) continue;
    std::array<char, 1024> bytes;
    const ssize_t count = recv(control.number(), bytes.data(), bytes.size(), 0);
    if (count <= 0) break;
    answer.append(bytes.data(), static_cast<std::size_t>(count));
  }
  return answer;
}

void expect_ready(const std::optional<std::string>& answer) {
  if (!answer)
    throw Failure("the display has not answered for " + std::to_string(kPatience.count()) + " seconds", "", kOtherWays);
  if (!answer->empty() && answer->front() == kReady) return;
  const std::size_t line = answer->find('\n');
  if (line == std::string::npos) throw Failure("the window's program ended while it started", kProgram, kOtherWays);
  throw Failure(answer->substr(0, line), "", answer->substr(line + 1) + kOtherWays);
}

}  // namespace

std::optional<std::filesystem::path> find_program(const std::filesystem::path& self) {
  for (const std::filesystem::path& folder : {self.parent_path(), self.parent_path().parent_path() / "libexec"})
    if (child::runnable(folder / kProgram)) return folder / kProgram;
  return std::nullopt;
}

WindowProcess::WindowProcess(const std::filesystem::path& self, Shows shows, const std::string& title,
                             const child::Descriptor& connection)
    : control_(child::make_socket_pair()),
      process_(command_for(self, shows, title), setup_of(control_.theirs, connection, child::null_device())) {
  control_.theirs.close();
  expect_ready(answer_of(control_.ours));
}

void WindowProcess::leave() {
  if (send(control_.ours.number(), &kLeft, 1, MSG_NOSIGNAL) == 1) process_.give_up();
}

}  // namespace mars::window
