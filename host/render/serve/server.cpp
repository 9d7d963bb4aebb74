#include "host/render/serve/server.h"

#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <optional>

#include "hal/failure/explain.h"
#include "hal/failure/failure.h"
#include "hal/nx/nx_messages.h"
#include "host/render/serve/live_pictures.h"
#include "host/render/serve/live_work.h"
#include "host/render/session/event_reporter.h"
#include "host/render/session/heartbeat_listener.h"
#include "host/render/session/status_board.h"
#include "host/render/session/termination.h"

namespace mars::serve {
namespace {

constexpr std::chrono::milliseconds kLastWords{1000};  // that the studio has to take why the host ends

// Its last message.
void send_refusal(pictures::Socket& studio, const std::string& text) {
  studio.send({pictures::Kind::refused}, pictures::body_of(text));
  const auto last = std::chrono::steady_clock::now() + kLastWords;
  studio.drain([last] { return std::chrono::steady_clock::now() >= last; });
}

child::Descriptor connect_to_studio(const std::string& path) {
  child::Descriptor descriptor = pictures::connect_to(path);
  if (descriptor.open()) return descriptor;
  throw Failure(std::string("no studio answers: ") + std::strerror(errno), path,
                "the host of a studio runs on its machine");
}

void serve(const Serving& serving, pictures::Socket& studio, session::EventReporter& reporter) {
  session::Termination termination(true);
  farm::Heartbeats heartbeats(session::host_name(), getpid(), heartbeat_listener(reporter, termination));
  farm::Engine engine({.width = wire::kMaxSide, .height = wire::kMaxSide, .heartbeats = &heartbeats});
  engine.shake_hands();
  reporter.listener(0).booted(engine.inbox().hellos(), 0, 0);
  engine.set_doing("waiting for the studio");
  LivePictures pictures(engine, studio, serving.block);
  LiveWork work(engine, studio, pictures, serving.mapping, serving.block);
  engine.run(work, pictures);
  engine.stop(true);
  reporter.report(events::Done{pictures.sent(), engine.seconds(), ""});
}

}  // namespace

void serve(const Serving& serving) {
  session::StatusBoard board("the studio's");
  session::EventReporter reporter(serving.backend, board);
  std::optional<pictures::Socket> studio;
  try {
    studio.emplace(connect_to_studio(serving.socket), pictures::Peer::studio);
    serve(serving, *studio, reporter);
  } catch (const std::exception& reason) {
    reporter.report(session::fault_of(reason));
    if (studio) send_refusal(*studio, reason_of(reason));
    throw;
  }
}

}  // namespace mars::serve
