// Every check on made-up surroundings: what is found, how bad it is, and that there is something to do.
#include "host/shell/doctor/checks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "tests/host/content/document/failure_of.h"

namespace mars::doctor {
namespace {

using State = Finding::State;

constexpr std::uint64_t kMiB = 1024 * 1024;
constexpr std::uint64_t kGiB = 1024 * kMiB;

// A machine on which nothing is wrong.
Facts sound() {
  Facts facts;
  facts.host = "ada";
  facts.programs = {"/usr/bin/mpirun",
                    "/opt/mars/mars-host",
                    "/opt/mars/mars-node",
                    "/opt/mars/mars-threads",
                    "/opt/mars/mars-simulated",
                    launch::Mpi::open_mpi,
                    {}};
  facts.surroundings = {8, 8, 0, false, false, false, {}};
  facts.mpirun_version = "mpirun (Open MPI) 4.1.4\n\nReport bugs to http://www.open-mpi.org/community/help/\n";
  facts.processors = facts.machine_processors = 8;
  facts.simd = "avx2";
  facts.memory = 32 * kGiB;
  facts.shared = Space{16 * kGiB, 16 * kGiB};
  facts.temporary = "/tmp";
  facts.temporary_space = Space{100 * kGiB, 50 * kGiB};
  facts.ffmpeg = facts.window = true;
  facts.view_library = "2.1.2";
  facts.display = ":0";
  facts.nodes = 8;
  return facts;
}

SlurmJob job(std::uint32_t machines) {
  return {"71",
          machines,
          0,
          "",
          "",
          true,
          "MPI plugin types are...\n\tnone\n\tpmi2\n\tpmix\nspecific pmix plugin versions: pmix_v4\n"};
}

// Of the surroundings as `change` leaves them.
std::vector<Finding> findings(const std::function<void(Facts&)>& change) {
  Facts facts = sound();
  change(facts);
  return check_machine(facts);
}

// That there is a finding of this state about this thing whose text and remedy hold these words.
void expect(State state, const std::string& about, const std::string& found, const std::string& remedy,
            const std::function<void(Facts&)>& change) {
  const std::vector<Finding> all = findings(change);
  EXPECT_TRUE(std::any_of(all.begin(), all.end(),
                          [&](const Finding& each) {
                            return each.state == state && each.about == about && document::holds(each.found, found) &&
                                   document::holds(each.remedy, remedy);
                          }))
      << about << ": " << found << " (" << remedy << ")";
  for (const Finding& each : all) EXPECT_TRUE(each.state != State::trouble || !each.remedy.empty()) << each.found;
}

TEST(Checks, NothingIsWrongWithASoundMachine) {
  for (const Finding& each : findings([](Facts&) {})) {
    EXPECT_EQ(each.state, State::good) << each.about << ": " << each.found;
    EXPECT_EQ(each.remedy, "") << each.about;
  }
}

TEST(Checks, Mpi) {
  expect(State::good, "MPI", "Open MPI 4.1.4, /usr/bin/mpirun", "", [](Facts&) {});
  expect(State::note, "MPI", "threads of one process", "openmpi-bin", [](Facts& f) { f.programs.mpirun.reset(); });
  expect(State::trouble, "MPI", "was not found", "openmpi-bin", [](Facts& f) {
    f.programs.mpirun.reset();
    f.slurm = job(2);
  });
  expect(State::note, "MPI", "Open MPI 5.0.3", "4.1", [](Facts& f) { f.mpirun_version = "mpirun (Open MPI) 5.0.3\n"; });
  expect(State::trouble, "MPI", "not Open MPI's: HYDRA build details:", "PATH",
         [](Facts& f) { f.mpirun_version = "HYDRA build details:\n    Version:  4.0.2\n"; });
  expect(State::good, "MPI", "MPICH 4.0.2, /usr/bin/mpirun", "", [](Facts& f) {
    f.programs.mpi = launch::Mpi::mpich;
    f.mpirun_version = "HYDRA build details:\n    Version:                                 4.0.2\n";
  });
  expect(State::trouble, "MPI", "not MPICH's: mpirun (Open MPI) 4.1.4", "module load mpich",
         [](Facts& f) { f.programs.mpi = launch::Mpi::mpich; });
  expect(State::good, "MPI", "Open MPI, /usr/bin/mpirun", "", [](Facts& f) { f.mpirun_version.reset(); });
  expect(State::trouble, "MPI", "says nothing", "--backend threads", [](Facts& f) { f.mpirun_version = ""; });
}

TEST(Checks, Programs) {
  expect(State::trouble, "programs", "mars-host, mars-node", "one folder", [](Facts& f) {
    f.programs.host.reset();
    f.programs.node.reset();
  });
  expect(State::note, "programs", "mars-host, mars-node", "MPI is installed", [](Facts& f) {
    f.programs = {std::nullopt,
                  std::nullopt,
                  std::nullopt,
                  "/opt/mars/mars-threads",
                  "/opt/mars/mars-simulated",
                  launch::Mpi::open_mpi,
                  {}};
  });
  expect(State::note, "programs", "/usr/bin/mars-node", "different versions",
         [](Facts& f) { f.programs.node = "/usr/bin/mars-node"; });
  expect(State::trouble, "programs", "libmpi.so.40", "module load", [](Facts& f) { f.lacking = {"libmpi.so.40"}; });
}

TEST(Checks, Processors) {
  expect(State::note, "processors", "the machine has 64 processors", "taskset",
         [](Facts& f) { f.machine_processors = 64; });
  expect(State::good, "processors", "the machine has 64 processors", "", [](Facts& f) {
    f.machine_processors = 64;
    f.slurm = job(1);
  });
  expect(State::good, "processors", "8 cores, 16 hardware threads", "",
         [](Facts& f) { f.processors = f.machine_processors = 16; });
  expect(State::note, "processors", "sse2 only", "", [](Facts& f) { f.simd = "sse2"; });
}

TEST(Checks, Slots) {
  expect(State::note, "slots", "16 nodes on 8 cores", "--nodes 8", [](Facts& f) { f.nodes = 16; });
  expect(State::note, "slots", "the job has 4 tasks", "sbatch -n 9", [](Facts& f) {
    f.slurm = job(1);
    f.slurm->tasks = 4;
  });
}

TEST(Checks, Memory) {
  expect(State::good, "memory", "32 GiB; for a node's frames 2.0 GiB", "", [](Facts&) {});
  expect(State::good, "memory", "32 GiB, 8.0 GiB of it for this job (cgroup); for a node's frames 512 MiB", "",
         [](Facts& f) { f.limit.together = 8 * kGiB; });
  expect(State::good, "memory", "16 GiB of addresses a process (ulimit -v); for a node's frames 512 MiB", "",
         [](Facts& f) { f.limit.each.addresses = 16 * kGiB; });
  expect(State::good, "memory", "1.0 GiB a process (ulimit -d)", "", [](Facts& f) { f.limit.each.data = kGiB; });
  expect(State::note, "memory", "for a node's frames 64 MiB", "fewer --nodes",
         [](Facts& f) { f.limit.together = kGiB; });
  expect(State::note, "memory", "100 MiB (MARS_MEMORY)", "", [](Facts& f) { f.memory_setting = 100 * kMiB; });
  expect(State::good, "memory", "stationary parts are kept up to 3360x1890 at 4 samples, 1712x963 at 16", "",
         [](Facts&) {});
  expect(State::good, "memory", "kept up to 16384x9216 at 4 samples", "",
         [](Facts& f) { f.memory_setting = 1024 * kGiB; });
}

TEST(Checks, SharedMemory) {
  expect(State::good, "/dev/shm", "64 MiB, 64 MiB free", "", [](Facts& f) {
    f.shared = Space{64 * kMiB, 64 * kMiB};
    f.nodes = 8;
  });
  expect(State::note, "/dev/shm", "many nodes", "--shm-size=1g", [](Facts& f) {
    f.shared = Space{256 * kMiB, 256 * kMiB};
    f.nodes = 128;
  });
  expect(State::trouble, "/dev/shm", "64 MiB, 1 MiB free", "may be deleted", [](Facts& f) {
    f.shared = Space{64 * kMiB, kMiB};
  });
  expect(State::trouble, "/dev/shm", "is not there", "tmpfs", [](Facts& f) { f.shared.reset(); });
}

TEST(Checks, Containers) {
  expect(State::note, "copies", "CMA", "--cap-add=SYS_PTRACE",
         [](Facts& f) { f.surroundings.copies_forbidden = true; });
  expect(State::note, "user", "root in a container (docker)", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1", [](Facts& f) {
    f.surroundings.root = true;
    f.container = "docker";
  });
  expect(State::good, "user", "not root in a container (podman)", "", [](Facts& f) { f.container = "podman"; });
}

TEST(Checks, TemporaryFiles) {
  expect(State::trouble, "TMPDIR", "/tmp cannot be written", "set TMPDIR", [](Facts& f) { f.temporary_space.reset(); });
  expect(State::trouble, "TMPDIR", "1 MiB free", "empty it", [](Facts& f) { f.temporary_space = Space{kGiB, kMiB}; });
}

TEST(Checks, OpenFiles) {
  expect(State::trouble, "open files", "a process may have 40, mpirun needs about 72 for 8 nodes", "ulimit -n 1024",
         [](Facts& f) { f.open_files = 40; });
  expect(State::good, "open files", "enough for 8 nodes", "", [](Facts& f) { f.open_files = 72; });
}

TEST(Checks, OtherMachines) {
  expect(State::note, "ssh", "this machine only", "openssh-client",
         [](Facts& f) { f.surroundings.no_remote_shell = true; });
  expect(State::trouble, "srun", "was not found", "client", [](Facts& f) {
    f.slurm = job(3);
    f.slurm->srun = false;
    f.surroundings.no_remote_shell = true;
  });
  expect(State::good, "Slurm", "job 71, 3 machines", "", [](Facts& f) { f.slurm = job(3); });
  expect(State::note, "srun", "no plugin pmix", "mpirun", [](Facts& f) {
    f.slurm = job(1);
    f.slurm->plugins = "none\npmi2\n";
  });
  const auto of_cpus = [](const char* srun) {
    return [srun](Facts& f) {
      f.slurm = job(1);
      f.slurm->cpus_per_task = "4";
      f.slurm->srun_cpus_per_task = srun;
    };
  };
  expect(State::note, "srun", "--cpus-per-task", "SRUN_CPUS_PER_TASK=$SLURM_CPUS_PER_TASK", of_cpus(""));
  for (const Finding& each : findings(of_cpus("4"))) EXPECT_NE(each.about, "srun");
}

TEST(Checks, Video) {
  expect(State::note, "ffmpeg", "was not found", "Debian: ffmpeg", [](Facts& f) { f.ffmpeg = false; });
}

TEST(Checks, Views) {
  expect(State::good, "OpenColorIO", "2.1.2", "", [](Facts&) {});
  expect(State::note, "OpenColorIO", "--ocio is refused", "libopencolorio-dev",
         [](Facts& f) { f.view_library.reset(); });
}

TEST(Checks, Windows) {
  expect(State::note, "window", "lacks libSDL2-2.0.so.0", "libsdl2-2.0-0",
         [](Facts& f) { f.window_lacking = {"libSDL2-2.0.so.0"}; });
  expect(State::note, "window", "was not found", "libsdl2-dev", [](Facts& f) { f.window = false; });
  expect(State::good, "window", "no display", "", [](Facts& f) { f.display.clear(); });
  expect(State::good, "window", "display :0", "", [](Facts&) {});
}

TEST(Checks, AStart) {
  launch::Trial trial;
  trial.command = "mpirun x";
  trial.boot_seconds = 0.52;
  trial.frames = 4;
  trial.booted = {"mpi", 1, {{}, {}}};
  EXPECT_EQ(check_start(trial),
            (Finding{State::good, "a start", "2 nodes on 1 machine (mpi) booted in 0.5 s, rendered 4 frames", ""}));
  trial.failure = Failure("the host was killed", "machine ada", "look at dmesg");
  EXPECT_EQ(check_start(trial),
            (Finding{State::trouble, "a start", "machine ada: the host was killed", "look at dmesg\nmpirun x"}));
}

}  // namespace
}  // namespace mars::doctor
