#include "hal/processes/processes_world.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <optional>
#include <system_error>

#include "hal/failure/failure.h"
#include "hal/messages/process.h"

namespace mars::processes {
namespace {

constexpr std::uint64_t kAlone = std::uint64_t{1} << 32;  // bytes that a node alone may send itself
constexpr std::int64_t kSleep = 100'000'000;              // nanoseconds

// Nodes begin at the host's first message at the latest.
class HostBackend : public ProcessesBackend {
 public:
  HostBackend(const Segment& segment, int index, ProcessesWorld& world)
      : ProcessesBackend(segment, index), world_(world) {}

  void send(int to, int type, const void* data, std::size_t length) override {
    world_.begin();
    ProcessesBackend::send(to, type, data, length);
  }
  std::optional<messages::Envelope> peek() override {
    world_.begin();
    return ProcessesBackend::peek();
  }

 private:
  ProcessesWorld& world_;
};

namespace fs = std::filesystem;

bool runnable(const fs::path& file) {
  std::error_code ignored;
  return fs::is_regular_file(file, ignored) && access(file.c_str(), X_OK) == 0;
}

// As given; else beside the host program: the folders that programs of 1990 name are gone.
fs::path find_program(const fs::path& file) {
  const fs::path beside = fs::read_symlink("/proc/self/exe").parent_path() / file.filename();
  for (const fs::path& each : {file, beside})
    if (runnable(each)) return each;
  const bool there = fs::exists(file) || fs::exists(beside);
  throw Failure(there ? "is not a program that can be run" : "there is no such program", file.string(),
                "give the path of a program, or put it beside the host program");
}

}  // namespace

ProcessesWorld::ProcessesWorld(const Place& place)
    : segment_(place.segment), place_(place), slot_(segment_.slot(place.index)) {
  // Also for what a script started: when that is killed, so are we.
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  for (const int descriptor : {place.segment, place.socket})
    if (descriptor >= 0) fcntl(descriptor, F_SETFD, FD_CLOEXEC);
  if (place.socket >= 0)
    backend_ = std::make_unique<HostBackend>(segment_, place.index, *this);
  else
    backend_ = std::make_unique<ProcessesBackend>(segment_, place.index);
  slot_.life = Life::joined;
}

ProcessesWorld::ProcessesWorld()
    : segment_(1, false, kAlone), slot_(segment_.slot(0)), backend_(std::make_unique<ProcessesBackend>(segment_, 0)) {
  slot_.life = Life::joined;
}

void ProcessesWorld::leave(int) { slot_.life = Life::left; }

void ProcessesWorld::fail(const std::string& reason) {
  if (!segment_.stopped()) {
    std::fflush(nullptr);
    std::fprintf(stderr, "%s\n", reason.c_str());
  }
  segment_.stop(reason);
  std::fflush(nullptr);
  std::_Exit(1);
}

int ProcessesWorld::ask(JobRequest::What what, int node, const std::string& file) {
  JobRequest request{what, node, {}};
  if (file.size() >= sizeof request.file) return ENAMETOOLONG;
  std::memcpy(request.file, file.c_str(), file.size());
  std::int32_t answer = ECONNRESET;
  const bool asked = ::send(place_.socket, &request, sizeof request, MSG_NOSIGNAL) == sizeof request;
  ssize_t got = -1;
  while (asked && (got = recv(place_.socket, &answer, sizeof answer, 0)) < 0 && errno == EINTR) {
  }
  return got == sizeof answer ? answer : ECONNRESET;
}

void ProcessesWorld::begin() {
  if (begun_) return;
  begun_ = true;
  ask(JobRequest::What::begin, -1, "");
}

void ProcessesWorld::resize(int nodes) {
  for (int node = 0; node < segment_.nodes(); ++node)
    if (status(node).state == State::running) throw Failure("nodes run already", "", "get the cube before they begin");
  segment_.header().cube = nodes;
}

void ProcessesWorld::load(const std::string& file, int node) {
  begun_ = true;
  const std::string program = fs::absolute(find_program(file)).string();
  if (status(node).state == State::running)
    throw Failure("node " + std::to_string(node) + " still runs another program", "",
                  "wait for its end or kill it first");
  messages::process().reset_peer(node);
  const int error = ask(JobRequest::What::load, node, program);
  if (error != 0) throw Failure(std::strerror(error), file, "");
}

void ProcessesWorld::kill(int node) {
  ask(JobRequest::What::kill, node, "");
  if (node < 0) segment_.flush(place_.index);
}

messages::World::Status ProcessesWorld::status(int node) {
  const Slot& slot = segment_.slot(node);
  switch (slot.life.load()) {
    case Life::none: return {State::nothing, 0};
    case Life::started:
    case Life::joined:
    case Life::left: return {State::running, 0};
    default: return {State::ended, slot.code};
  }
}

void ProcessesWorld::wait_for_end() {
  slot_.waiting = Waiting::for_end;
  slot_.asleep = 1;
  Segment::sleep(slot_, kSleep);
  slot_.asleep = 0;
  slot_.waiting = Waiting::no;
}

}  // namespace mars::processes
