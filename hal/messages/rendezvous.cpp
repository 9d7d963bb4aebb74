#include "hal/messages/rendezvous.h"

#include <algorithm>
#include <cstdio>
#include <utility>

#include "hal/messages/arguments.h"

namespace mars::messages {

void Rendezvous::expect(int rank, std::uint32_t number, Request& request) {
  expected_.push_back({rank, number, &request});
  ++request.unreceived;
}

void Rendezvous::received(int rank, std::uint32_t number) {
  const auto at = std::find_if(expected_.begin(), expected_.end(),
                               [&](const Expected& each) { return each.rank == rank && each.number == number; });
  if (at == expected_.end()) return;  // of a send that was cancelled
  --at->request->unreceived;
  expected_.erase(at);
}

void Rendezvous::forget(const Request& request) {
  std::erase_if(expected_, [&](const Expected& each) { return each.request == &request; });
}

void Rendezvous::begin_silence() {
  quiet_since_ = std::chrono::steady_clock::now();
  reported_ = false;
}

std::string Rendezvous::awaited(const Caller& caller, const Request& request) const {
  const auto name = [&](int rank) { return rank_name(rank, caller.backend().host()); };
  const int type = request.selection.typesel;
  if (request.state == Request::State::receiving) {
    if (type >= kFirstInternalType && type_class(type) == TypeClass::reserved)
      return "for " + name(type - kFirstInternalType);
    return "for a message, typesel " + std::to_string(type);
  }
  const auto at =
      std::find_if(expected_.begin(), expected_.end(), [&](const Expected& each) { return each.request == &request; });
  if (at == expected_.end()) return "for its message to leave";
  return "until " + name(at->rank) + " receives " + bytes_text(request.envelope.length) + ", type " +
         std::to_string(request.envelope.type);
}

void Rendezvous::report_silence(const Caller& caller, const Request& request) {
  if (std::chrono::steady_clock::now() - quiet_since_ >= *patience_) report_wait(caller, request);
}

void Rendezvous::report_wait(const Caller& caller, const Request& request) {
  if (std::exchange(reported_, true)) return;
  const std::chrono::duration<double> silence = std::chrono::steady_clock::now() - quiet_since_;
  const std::string me = rank_name(caller.backend().rank(), caller.backend().host());
  std::fprintf(stderr, "%s has waited %.1f s in %s %s (strict mode: what is longer than %zu bytes is not buffered)\n",
               me.c_str(), silence.count(), request.call, awaited(caller, request).c_str(), kBuffered);
}

}  // namespace mars::messages
