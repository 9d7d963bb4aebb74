#include "tests/hal/faults/faults.h"

#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <functional>
#include <map>
#include <thread>

#include "hal/failure/failure.h"
#include "hal/nx/nx_global.h"
#include "hal/nx/nx_messages.h"

namespace mars::faults {
namespace {

constexpr long kNever = 9;

void wait_for_ever() { crecv(kNever, nullptr, 0); }

bool falls() { return mynode() == 1; }

void fall(const std::string& way) {
  if (way == "exits") std::_Exit(3);
  if (way == "crashes") {
    signal(SIGSEGV, SIG_DFL);  // sanitizers would report it
    raise(SIGSEGV);
  }
  if (way == "killed") kill(getpid(), SIGKILL);
  throw Failure("a fault on purpose", "", "");
}

void start(const std::string& way) {
  if (falls()) fall(way);
  wait_for_ever();
}

void waiting(const std::string& way) {
  if (falls()) {
    csend(1, nullptr, 0, -1, 0);
    std::this_thread::sleep_for(std::chrono::milliseconds(30));
    fall(way);
  }
  if (mynode() != myhost()) crecv(1, nullptr, 0);
  wait_for_ever();
}

void collective(const std::string& way) {
  if (mynode() == myhost()) wait_for_ever();
  for (int turn = 0;; ++turn) {
    if (falls() && turn == 20) fall(way);
    gsync();
  }
}

// The handler has no other way to know; one fault is tried at a time in a program.
std::string way_of_the_handler;

void handler(const std::string& way) {
  if (falls()) {
    way_of_the_handler = way;
    hrecv(1, nullptr, 0, [](long, long, long, long) { fall(way_of_the_handler); });
  }
  if (mynode() == 0) csend(1, nullptr, 0, 1, 0);
  wait_for_ever();
}

void sending(const std::string& way) {
  if (mynode() == myhost()) wait_for_ever();
  std::vector<char> out(8'000'000), in(out.size());
  const auto length = static_cast<long>(out.size());
  const long mid = isend(1, out.data(), length, (mynode() + 1) % numnodes(), 0);
  if (falls()) fall(way);
  crecv(1, in.data(), length);
  msgwait(mid);
  wait_for_ever();
}

void end(const std::string& way) {
  if (!falls()) return;
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  fall(way);
}

}  // namespace

void run_rank(const Fault& fault) {
  static const std::map<std::string, std::function<void(const std::string&)>> moments = {
      {"start", start},     {"waiting", waiting}, {"collective", collective},
      {"handler", handler}, {"sending", sending}, {"end", end}};
  moments.at(fault.moment)(fault.way);
}

}  // namespace mars::faults
