#include "hal/program/program.h"

#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <memory>
#include <optional>
#include <string>
#include <thread>

#include "hal/failure/explain.h"
#include "hal/failure/failure.h"
#include "hal/messages/settings.h"
#include "hal/nx/cfs.h"
#include "hal/nx/guard.h"
#include "hal/nx/progress_thread.h"
#include "hal/processes/processes_world.h"
#ifdef MARS_NX_MPI
#include "hal/mpi/join.h"
#endif

namespace mars::program {
namespace {

// After which a strict program reports what it waits for.
constexpr std::chrono::seconds kPatience{5};

struct Program {
  std::unique_ptr<messages::World> world;
  std::optional<messages::Process> process;
  std::optional<nx::ProgressThread> progress;  // of the process
  std::thread::id thread;
  pid_t id = 0;  // of the process that is the rank: the first, or the one that made the first call
};

// Never destroyed: the program's own exit functions may still call.
Program& program() {
  static Program* only = new Program;
  return *only;
}

[[noreturn]] void end(const std::string& reason) {
  if (program().world != nullptr) program().world->fail(reason);
  std::fprintf(stderr, "%s\n", reason.c_str());
  std::fflush(nullptr);
  std::_Exit(1);
}

// The last of the program's exit functions, in the process itself and not in one that it forked.
void leave(int code, void*) try {
#ifdef MARS_NX_MPI
  // The others wait for it.
  if (program().world == nullptr && program().id == getpid() && messages::started_by_mpi()) world();
#endif
  if (program().world == nullptr || program().id != getpid()) return;
  std::fflush(nullptr);
  program().progress.reset();
  if (program().process) nx::end_files(*program().process);
  program().world->leave(code);
} catch (const std::exception& failure) {
  end(reason_of(failure));
}

std::unique_ptr<messages::World> connect() {
  if (const std::optional<processes::Place> place = processes::take_place())
    return std::make_unique<processes::ProcessesWorld>(*place);
#ifdef MARS_NX_MPI
  if (messages::started_by_mpi()) {
    const messages::Settings settings = messages::read_settings();
    return mpi::join_mpi(settings.nx_host, settings.nx_handler_thread);
  }
#endif
  return std::make_unique<processes::ProcessesWorld>();
}

messages::Process& find_process() {
  messages::Backend& backend = world().backend();
  if (!program().process) {
    const messages::Settings settings = messages::read_settings();
    program().process.emplace(backend);
    program().process->set_collectives(settings.nx_collectives);
    if (settings.nx_strict) program().process->set_strict(kPatience);
    if (settings.nx_handler_thread) program().progress.emplace(*program().process);
  }
  return *program().process;
}

// Before main, so that it is the last that exit calls.
[[gnu::constructor]] void prepare() {
  // Each line is printed as it is written, and is not lost with a process that is killed.
  std::setvbuf(stdout, nullptr, _IOLBF, BUFSIZ);
  program().id = getpid();
  messages::find_process_by(find_process);
  nx::end_program_on_failure(end);
  on_exit(leave, nullptr);
}

}  // namespace

messages::World& world() {
  Program& program = program::program();
  if (program.world == nullptr) {
    program.thread = std::this_thread::get_id();
    program.id = getpid();
    program.world = connect();
  }
  if (program.thread != std::this_thread::get_id() || program.id != getpid())
    throw Failure("an NX call on another thread or in another process than the first", "",
                  "make all NX calls of a program on one thread of it");
  return *program.world;
}

void renew_process() {
  program().progress.reset();
  program().process.reset();
}

}  // namespace mars::program
