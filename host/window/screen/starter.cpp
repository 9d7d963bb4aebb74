#include "host/window/screen/starter.h"

#include <sys/socket.h>

#include <cstdlib>

#include "host/window/window_process.h"

namespace mars::window {

Starter::Starter() : control_(kControl), thread_([this] { wait_for_its_end(); }) {}

Starter::~Starter() {
  ending_ = true;
  shutdown(control_.number(), SHUT_RDWR);
  thread_.join();
}

void Starter::send_ready() { send(control_.number(), &kReady, 1, MSG_NOSIGNAL); }

void Starter::explain(const std::string& problem, const std::string& remedy) {
  const std::string lines = problem + '\n' + remedy;
  send(control_.number(), lines.data(), lines.size(), MSG_NOSIGNAL);
}

void Starter::wait_for_its_end() {
  char word = 0;
  const ssize_t count = recv(control_.number(), &word, 1, 0);
  left_ = count == 1 && word == kLeft;
  if (!left_ && !ending_) std::_Exit(0);
}

}  // namespace mars::window
