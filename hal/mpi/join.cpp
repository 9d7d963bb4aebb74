#include "hal/mpi/join.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include <mpi.h>

#include "hal/failure/failure.h"
#include "hal/messages/process.h"
#include "hal/mpi/control.h"
#include "hal/mpi/mpi_backend.h"
#include "hal/mpi/mpi_call.h"
#include "hal/mpi/patience.h"

namespace mars::mpi {
namespace {

constexpr std::chrono::milliseconds kNap{2};
constexpr std::chrono::seconds kPatienceWithKilled{2};
// A caller that lets that much time pass has nothing to do before a message comes.
constexpr std::chrono::microseconds kPatience{5000};
constexpr int kLooksBefore = 100;  // turns of a wait before control messages are looked for

using Name = std::array<char, 512>;  // a program's path, its end if it is long

Name own_name() {
  const std::string path = std::filesystem::read_symlink("/proc/self/exe").string();
  Name name{};
  path.copy(name.data(), name.size() - 1, path.size() - std::min(path.size(), name.size() - 1));
  return name;
}

// MPI itself would spin.
void wait(MPI_Request& request) {
  int done = 0;
  while (succeed(MPI_Test(&request, &done, MPI_STATUS_IGNORE), "MPI_Test"), done == 0)
    std::this_thread::sleep_for(kNap);
}

class MpiWorld;

// The messages of a rank that also looks for control messages. Nodes begin at the host's first message at the latest.
class JoinedBackend : public MpiBackend {
 public:
  JoinedBackend(MpiWorld& world, bool host, MPI_Comm ranks)
      : MpiBackend(host ? 0 : -1, ranks), world_(world), host_(host) {}

  bool has_host() const override { return host_; }
  void send(int to, int type, const void* data, std::size_t length) override;
  std::optional<messages::Ticket> send_or_start(int to, int type, const void* data, std::size_t length) override;
  messages::Ticket start_send(int to, int type, const void* data, std::size_t length) override;
  std::optional<messages::Envelope> peek() override;
  void idle(int turn, std::chrono::microseconds longest) override;

 private:
  MpiWorld& world_;
  const bool host_;
};

class MpiWorld final : public messages::World {
 public:
  MpiWorld(std::optional<bool> host, bool two_threads);

  messages::Backend& backend() override;
  bool is_host() const override { return has_host_ && rank_ == 0; }
  void leave(int code) override;
  [[noreturn]] void fail(const std::string& reason) override;

  int all_nodes() const override { return size_ - 1; }
  void resize(int nodes) override;
  void begin() override {
    if (!begun_) begin_all();
  }
  void load(const std::string& file, int node) override;
  void kill(int node) override;
  Status status(int node) override;
  void wait_for_end() override;

  // Receives control messages; does not return where this rank is to end.
  void look(bool waits);

 private:
  void make_cube();
  void begin_all();
  void start(int node);
  void await_start();
  void dismiss();
  [[noreturn]] void end_now(int code);

  int rank_ = 0;
  int size_ = 0;
  bool has_host_ = false;
  std::vector<Name> names_;  // of the ranks' programs
  int cube_ = 0;             // nodes
  std::unique_ptr<JoinedBackend> backend_;
  std::optional<Control> control_;
  std::vector<int> rank_of_;   // by id
  std::vector<bool> started_;  // by id
  bool begun_ = false;         // this node; for the host: one at least, and no other by itself any more
  std::optional<int> left_;    // the code with which it leaves
};

void JoinedBackend::send(int to, int type, const void* data, std::size_t length) {
  world_.begin();
  MpiBackend::send(to, type, data, length);
}

std::optional<messages::Ticket> JoinedBackend::send_or_start(int to, int type, const void* data, std::size_t length) {
  world_.begin();
  return MpiBackend::send_or_start(to, type, data, length);
}

messages::Ticket JoinedBackend::start_send(int to, int type, const void* data, std::size_t length) {
  world_.begin();
  return MpiBackend::start_send(to, type, data, length);
}

std::optional<messages::Envelope> JoinedBackend::peek() {
  world_.begin();
  return MpiBackend::peek();
}

void JoinedBackend::idle(int turn, std::chrono::microseconds longest) {
  if (turn >= kLooksBefore) world_.look(longest >= kPatience);
  MpiBackend::idle(turn, longest);
}

// The program may have done so itself.
void begin_mpi(bool two_threads) {
  int before = 0;
  MPI_Initialized(&before);
  int level = MPI_THREAD_SINGLE;
  if (before == 0)
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &level);
  else
    MPI_Query_thread(&level);
  if (two_threads && level < MPI_THREAD_SERIALIZED)
    throw Failure("handlers are to run on a thread of their own, and MPI takes calls of one thread only",
                  "environment variable MARS_NX_HANDLERS",
                  before == 0 ? "unset it" : "unset it, or call MPI_Init_thread for MPI_THREAD_SERIALIZED");
}

MpiWorld::MpiWorld(std::optional<bool> host, bool two_threads) {
  begin_mpi(two_threads);
  succeed(MPI_Comm_set_errhandler(MPI_COMM_WORLD, MPI_ERRORS_RETURN), "MPI_Comm_set_errhandler");
  prepare_to_wait();
  rank_ = rank_in(MPI_COMM_WORLD);
  size_ = size_of(MPI_COMM_WORLD);
  names_.resize(static_cast<std::size_t>(size_));
  const Name mine = own_name();
  succeed(MPI_Allgather(&mine, sizeof mine, MPI_BYTE, names_.data(), sizeof mine, MPI_BYTE, MPI_COMM_WORLD),
          "MPI_Allgather");
  const bool differs = std::find(names_.begin() + 1, names_.end(), names_[0]) == names_.end();
  int has_host = size_ > 1 && host.value_or(differs);
  succeed(MPI_Bcast(&has_host, 1, MPI_INT, 0, MPI_COMM_WORLD), "MPI_Bcast");
  has_host_ = has_host != 0;
  cube_ = size_ - has_host;
  begun_ = !has_host_;
  if (!is_host()) make_cube();
}

// Nodes wait here until the host has chosen the cube.
void MpiWorld::make_cube() {
  if (has_host_) {
    MPI_Request request = MPI_REQUEST_NULL;
    succeed(MPI_Ibcast(&cube_, 1, MPI_INT, 0, MPI_COMM_WORLD, &request), "MPI_Ibcast");
    wait(request);
  }
  const bool within = rank_ < cube_ + has_host_;
  MPI_Comm ranks = MPI_COMM_NULL;
  succeed(MPI_Comm_split(MPI_COMM_WORLD, within ? 0 : MPI_UNDEFINED, rank_, &ranks), "MPI_Comm_split");
  if (!within) end_now(0);
  backend_ = std::make_unique<JoinedBackend>(*this, has_host_, ranks);
  MPI_Comm by_id = MPI_COMM_NULL;
  succeed(MPI_Comm_split(ranks, 0, backend_->rank(), &by_id), "MPI_Comm_split");
  rank_of_.resize(static_cast<std::size_t>(size_of(by_id)));
  succeed(MPI_Allgather(&rank_, 1, MPI_INT, rank_of_.data(), 1, MPI_INT, by_id), "MPI_Allgather");
  started_.resize(rank_of_.size());
  control_.emplace(by_id);
}

messages::Backend& MpiWorld::backend() {
  if (backend_ == nullptr) make_cube();
  if (!begun_ && !is_host()) await_start();
  return *backend_;
}

// One that was never loaded goes when the host does.
void MpiWorld::await_start() {
  for (; !control_->begins(); std::this_thread::sleep_for(kNap)) look(true);
  begun_ = true;
  if (!*control_->begins()) end_now(0);
}

void MpiWorld::start(int node) {
  begun_ = true;
  started_[static_cast<std::size_t>(node)] = true;
  control_->start(node, true);
}

void MpiWorld::begin_all() {
  backend();
  for (int id = 0; id < cube_; ++id) start(id);
}

void MpiWorld::resize(int nodes) {
  if (backend_ != nullptr && nodes != cube_)
    throw Failure("under MPI a job has one cube, made before its nodes begin", "", "start it without --over mpi");
  cube_ = nodes;
}

void MpiWorld::load(const std::string& file, int node) {
  const std::filesystem::path runs = names_[static_cast<std::size_t>(rank_of_[static_cast<std::size_t>(node)])].data();
  if (runs.filename() != std::filesystem::path(file).filename())
    throw Failure("node " + std::to_string(node) + " runs " + runs.string() + ", as it was started under MPI", file,
                  "start that program on the nodes, or run without --over mpi");
  if (started_[static_cast<std::size_t>(node)])
    throw Failure("node " + std::to_string(node) + " has run its program already", file,
                  "under MPI it can once: run without --over mpi");
  start(node);
}

void MpiWorld::kill(int node) {
  const int first = node < 0 ? 0 : node;
  const int last = node < 0 ? cube_ : node + 1;
  for (int id = first; id < last; ++id)
    if (status(id).state == State::running) control_->kill(id);
  if (node >= 0) return;
  // One that computes goes at its next call, and is not waited for.
  const auto deadline = std::chrono::steady_clock::now() + kPatienceWithKilled;
  const auto runs = [this](int id) { return status(id).state == State::running; };
  for (int id = first; id < last; ++id)
    while (runs(id) && std::chrono::steady_clock::now() < deadline) wait_for_end();
  std::vector<std::byte> nothing;
  while (const std::optional<messages::Envelope> next = backend_->MpiBackend::peek()) {
    nothing.resize(next->length);
    backend_->take(nothing.data());
  }
}

messages::World::Status MpiWorld::status(int node) {
  backend();
  look(false);
  if (!started_[static_cast<std::size_t>(node)]) return {State::nothing, 0};
  const std::optional<int> code = control_->ended(node);
  return {code ? State::ended : State::running, code.value_or(0)};
}

void MpiWorld::wait_for_end() {
  look(true);
  std::this_thread::sleep_for(kNap);
}

void MpiWorld::look(bool waits) {
  control_->look(waits || left_, backend_->taken());
  if (control_->killed() && !left_) end_now(-SIGKILL);
  if (control_->stands_still())
    fail("every process waits for a message, and none is on its way; " +
         messages::rank_name(backend_->rank(), has_host_ ? backend_->host() : -1) + " has ended with exit code " +
         std::to_string(*left_));
}

void MpiWorld::end_now(int code) {
  std::fflush(nullptr);
  leave(code);
  std::_Exit(0);
}

// Nodes that have not begun do so now, if none has been loaded; else they end.
void MpiWorld::dismiss() {
  begin();
  for (int id = 0; id < cube_; ++id)
    if (!started_[static_cast<std::size_t>(id)]) control_->start(id, false);
}

void MpiWorld::leave(int code) {
  if (rank_ < cube_ + has_host_) {
    backend();
    if (is_host()) dismiss();
    left_ = code;
    if (has_host_ && !is_host()) control_->report_end(backend_->host(), code);
    if (code > 0) control_->watch();
    messages::process().finish();
  }
  MPI_Request request = MPI_REQUEST_NULL;
  succeed(MPI_Ibarrier(MPI_COMM_WORLD, &request), "MPI_Ibarrier");
  wait(request);
  int after = 0;
  MPI_Finalized(&after);
  if (after == 0) MPI_Finalize();
}

void MpiWorld::fail(const std::string& reason) {
  std::fflush(nullptr);
  std::fprintf(stderr, "%s\n", reason.c_str());
  MPI_Abort(MPI_COMM_WORLD, 1);
  std::_Exit(1);
}

}  // namespace

std::unique_ptr<messages::World> join_mpi(std::optional<bool> host, bool two_threads) {
  return std::make_unique<MpiWorld>(host, two_threads);
}

}  // namespace mars::mpi
