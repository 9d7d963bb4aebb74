// Loaded (LD_PRELOAD) into mars and so into all that it starts: one process, once, dies at a moment of its life. The
// file that DEATH names plans it in a line: the program (a shell's pattern), its rank (-1: any), the moment, the
// signal, as in "mars-node 2 35.5 9" (SIGSTOP: it only hangs). The moment is in milliseconds from its fork, or one of
//   fork        it is about to become the program
//   link        its libraries are loaded
//   init, initialized, finalize, finalized    before and after MPI_Init and MPI_Finalize
//   still:3, background:3, ...                it is about to send its third message of the kind (kKinds)
// Who is to die of a plan renames its file, FILE.taken, and who dies removes that.
#include <dlfcn.h>
#include <fcntl.h>
#include <fnmatch.h>
#include <poll.h>
#include <signal.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <climits>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <optional>

#include <mpi.h>

#include "node/wire/protocol.h"

namespace {

using Execute = int (*)(const char*, char* const[], char* const[]);
using Init = int (*)(int*, char***, int, int*);
using Finalize = int (*)();
using Send = int (*)(const void*, int, MPI_Datatype, int, int, MPI_Comm, MPI_Request*);

struct Plan {
  std::array<char, 32> program{};
  int rank = -1;
  std::array<char, 32> moment{};
  int signal = 0;
};

// Nothing here allocates: the process may be a copy of one with threads.
std::optional<Plan> read_plan(const char* file) {
  const int descriptor = file == nullptr ? -1 : open(file, O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return std::nullopt;
  std::array<char, 128> line{};
  const ssize_t length = read(descriptor, line.data(), line.size() - 1);
  close(descriptor);
  Plan plan;
  if (length <= 0 || std::sscanf(line.data(), "%31s %d %31s %d", plan.program.data(), &plan.rank, plan.moment.data(),
                                 &plan.signal) != 4)
    return std::nullopt;
  return plan;
}

const char* value_of(const char* name, char* const environment[]) {
  const std::size_t length = std::strlen(name);
  for (char* const* line = environment; line != nullptr && *line != nullptr; ++line)
    if (std::strncmp(*line, name, length) == 0 && (*line)[length] == '=') return *line + length + 1;
  return nullptr;
}

bool concerns(const Plan& plan, const char* path, char* const environment[]) {
  const char* slash = std::strrchr(path, '/');
  if (fnmatch(plan.program.data(), slash == nullptr ? path : slash + 1, 0) != 0) return false;
  if (plan.rank < 0) return true;
  for (const char* name : {"OMPI_COMM_WORLD_RANK", "PMI_RANK"})
    if (const char* rank = value_of(name, environment)) return std::atoi(rank) == plan.rank;
  return false;
}

using Name = std::array<char, PATH_MAX>;

Name taken(const char* file) {
  Name name{};
  std::snprintf(name.data(), name.size(), "%s.taken", file);
  return name;
}

// False where another has.
bool take_plan(const char* file) { return rename(file, taken(file).data()) == 0; }

// One that is only stopped goes on when a signal says so.
void die(const char* file, int how) {
  signal(how, SIG_DFL);
  sigset_t all;
  sigfillset(&all);
  sigprocmask(SIG_UNBLOCK, &all, nullptr);
  unlink(taken(file).data());
  kill(getpid(), how);
  while (how != SIGSTOP) pause();
}

// By a process beside it, which ends when it does.
void die_later(const char* file, double milliseconds, int how) {
  const pid_t victim = getpid();
  if (fork() != 0) return;
  const int watched = static_cast<int>(syscall(SYS_pidfd_open, victim, 0));
  for (int each = 0; each < 1024; ++each)
    if (each != watched) close(each);
  setsid();
  const timespec left{static_cast<time_t>(milliseconds / 1000), static_cast<long>(std::fmod(milliseconds, 1000) * 1e6)};
  pollfd ended{watched, POLLIN, 0};
  if (ppoll(&ended, 1, &left, nullptr) == 0 && syscall(SYS_pidfd_send_signal, watched, how, nullptr, 0) == 0)
    unlink(taken(file).data());
  _exit(0);
}

// At a moment that has a name.
void die_at(const char* moment) {
  const char* file = std::getenv("DEATH");
  const auto plan = read_plan(file);
  if (!plan || std::strcmp(plan->moment.data(), moment) != 0) return;
  std::array<char, PATH_MAX> self{};
  if (readlink("/proc/self/exe", self.data(), self.size() - 1) <= 0) return;
  if (concerns(*plan, self.data(), environ) && take_plan(file)) die(file, plan->signal);
}

// Messages between nodes; an MPI message's tag is their type.
struct Kind {
  const char* name;
  int tag;
};
constexpr std::array kKinds{Kind{"triangles", mars::wire::kTriangles}, Kind{"still", mars::wire::kStillLines},
                            Kind{"background", mars::wire::kBackground}, Kind{"picture", mars::wire::kPicture},
                            Kind{"bands", mars::wire::kBands}};

void die_at_message(int tag) {
  static std::array<int, kKinds.size()> sent{};
  for (std::size_t i = 0; i < kKinds.size(); ++i) {
    if (kKinds[i].tag != tag) continue;
    std::array<char, 32> moment{};
    std::snprintf(moment.data(), moment.size(), "%s:%d", kKinds[i].name, ++sent[i]);
    die_at(moment.data());
  }
}

Execute next_execute = nullptr;
Send next_send = nullptr;

[[gnu::constructor]] void begin() {
  next_execute = reinterpret_cast<Execute>(dlsym(RTLD_NEXT, "execve"));
  next_send = reinterpret_cast<Send>(dlsym(RTLD_NEXT, "MPI_Isend"));
  die_at("link");
}

}  // namespace

extern "C" {

int execve(const char* path, char* const words[], char* const environment[]) noexcept {
  const char* file = value_of("DEATH", environment);
  const auto plan = read_plan(file);
  if (plan && concerns(*plan, path, environment)) {
    const bool at_once = std::strcmp(plan->moment.data(), "fork") == 0;
    const bool later = plan->moment[0] >= '0' && plan->moment[0] <= '9';
    if ((at_once || later) && take_plan(file)) {
      if (at_once) die(file, plan->signal);
      die_later(file, std::atof(plan->moment.data()), plan->signal);
    }
  }
  return next_execute(path, words, environment);
}

int MPI_Init_thread(int* count, char*** words, int required, int* provided) {
  die_at("init");
  const int result = reinterpret_cast<Init>(dlsym(RTLD_NEXT, "MPI_Init_thread"))(count, words, required, provided);
  die_at("initialized");
  return result;
}

int MPI_Isend(const void* data, int count, MPI_Datatype type, int to, int tag, MPI_Comm ranks, MPI_Request* request) {
  die_at_message(tag);
  return next_send(data, count, type, to, tag, ranks, request);
}

int MPI_Finalize() {
  die_at("finalize");
  const int result = reinterpret_cast<Finalize>(dlsym(RTLD_NEXT, "MPI_Finalize"))();
  die_at("finalized");
  return result;
}
}
