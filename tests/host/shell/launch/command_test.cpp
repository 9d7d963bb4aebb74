#include "host/shell/launch/command.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "tests/host/content/document/failure_of.h"
#include "tests/temporary_folder.h"

namespace mars::launch {
namespace {

namespace fs = std::filesystem;

Programs all_programs() {
  return {"/usr/bin/mpirun",     "/opt/mars-host", "/opt/mars-node",       "/opt/mars-threads",
          "/opt/mars-simulated", Mpi::open_mpi,    "/opt/mars-loopback.so"};
}

options::RenderOptions film(std::uint32_t nodes) {
  options::RenderOptions options;
  options.film = "a film.json";
  options.folder = "out";
  options.nodes = nodes;
  return options;
}

std::string line(std::uint32_t nodes, const Surroundings& surroundings) {
  return shell_text(mpi_command(film(nodes), all_programs(), surroundings));
}

// A machine without a batch system.
Surroundings alone(std::uint32_t cores, std::vector<std::string> environment = {}) {
  return {cores, 2 * cores, 0, false, false, false, {}, 0, child::Environment(std::move(environment))};
}

Surroundings batch_job(std::uint32_t tasks) {
  return {2, 2, tasks, false, false, false, {}, 0, child::Environment({})};
}

fs::path write_hostfile(const test::TemporaryFolder& folder, const std::string& text) {
  std::ofstream(folder / "hosts") << text;
  return folder / "hosts";
}

void make_program(const fs::path& file) {
  fs::create_directories(file.parent_path());
  std::ofstream(file) << "#!/bin/sh\n";
  fs::permissions(file, fs::perms::owner_all);
}

TEST(Command, OneHostAndItsNodes) {
  EXPECT_EQ(
      line(3, alone(8)),
      "PMIX_MCA_gds=hash OMPI_MCA_pml=ob1 OMPI_MCA_btl=self,vader OMPI_MCA_orte_default_hostfile=none "
      "LD_PRELOAD=/opt/mars-loopback.so /usr/bin/mpirun --bind-to none -n 1 /opt/mars-host 'a film.json' -o out : -n 3 "
      "/opt/mars-node");
}

TEST(Command, OversubscribesWhereHostAndNodesExceedTheCores) {
  EXPECT_FALSE(document::holds(line(3, alone(4)), "--oversubscribe"));
  EXPECT_TRUE(document::holds(line(4, alone(4)), "--bind-to none --oversubscribe -n 1"));
}

TEST(Command, ABatchJobHasItsOwnRoom) {
  EXPECT_FALSE(document::holds(line(7, batch_job(8)), "--oversubscribe"));
  EXPECT_TRUE(document::holds(line(8, batch_job(8)), "--oversubscribe"));
  EXPECT_TRUE(document::holds(line(7, batch_job(8)), "OMPI_MCA_oob_tcp_keepalive_time=10"));
  EXPECT_FALSE(document::holds(line(7, batch_job(8)), "PMIX_MCA_gds"));
  EXPECT_FALSE(document::holds(line(3, alone(8)), "keepalive"));
}

TEST(Command, SrunHandsTheEnvironmentOn) {
  EXPECT_TRUE(document::holds(line(3, alone(8, {"SLURM_EXPORT_ENV=NONE"})), "SLURM_EXPORT_ENV=ALL "));
  EXPECT_FALSE(document::holds(line(3, alone(8)), "SLURM_EXPORT_ENV"));
}

TEST(Command, OnlyOnThisMachineDoesItKeepToTheLoopbackInterface) {
  const std::string held = "LD_PRELOAD=/opt/mars-loopback.so";
  EXPECT_EQ(mpi_command(film(3), all_programs(), alone(8)).open_mpi, child::OpenMpi::on_this_machine);
  for (const Surroundings& several : {batch_job(8), alone(8, {"LSB_HOSTS=n1"})}) {
    EXPECT_FALSE(document::holds(line(3, several), held));
    EXPECT_FALSE(document::holds(line(3, several), "OMPI_MCA_btl="));
    EXPECT_EQ(mpi_command(film(3), all_programs(), several).open_mpi, child::OpenMpi::on_several);
  }
  EXPECT_TRUE(document::holds(line(3, alone(8, {"LD_PRELOAD=a.so"})), held + ":a.so "));
  Programs programs = all_programs();
  programs.loopback = "/a folder/mars-loopback.so";
  EXPECT_FALSE(document::holds(shell_text(mpi_command(film(3), programs, alone(8))), "LD_PRELOAD"));
}

TEST(Command, WhatAPersonSetOfMpiCounts) {
  const std::string text = line(3, alone(8, {"OMPI_MCA_btl=tcp,self", "PMIX_MCA_gds=ds21"}));
  EXPECT_FALSE(document::holds(text, "OMPI_MCA_btl="));
  EXPECT_FALSE(document::holds(text, "PMIX_MCA_gds="));
  EXPECT_TRUE(document::holds(text, "OMPI_MCA_pml=ob1"));
}

TEST(Command, NamesOfFilesAreNoWordsForMpirun) {
  const test::TemporaryFolder folder;
  const fs::path before = fs::current_path();
  fs::current_path(folder / "");
  std::ofstream(":") << "n1\n";
  options::RenderOptions options = film(3);
  options.film = options.folder = options.report = options.hostfile = ":";
  options.trace = "-t";
  const child::Command command = mpi_command(options, all_programs(), alone(8));
  fs::current_path(before);
  EXPECT_EQ(std::count(command.words.begin(), command.words.end(), ":"), 1) << shell_text(command);
  EXPECT_EQ(std::count(command.words.begin(), command.words.end(), "./:"), 4) << shell_text(command);
  EXPECT_EQ(std::count(command.words.begin(), command.words.end(), "./-t"), 1) << shell_text(command);
}

TEST(Command, NoMpiWithinTooFewAddresses) {
  Surroundings surroundings = alone(8);
  surroundings.address_limit = std::uint64_t{200} << 20;
  EXPECT_TRUE(
      document::holds(document::failure_of([&] { line(3, surroundings); }), "ulimit -v: the limit of 204800 kB"));
  surroundings.address_limit = std::uint64_t{1} << 30;
  EXPECT_EQ(document::failure_of([&] { line(3, surroundings); }), "");
}

TEST(Command, AHostfileIsPassedOn) {
  const test::TemporaryFolder folder;
  options::RenderOptions options = film(7);
  options.hostfile = write_hostfile(folder, "n1 slots=2\nn2\n").string();
  const std::string text = shell_text(mpi_command(options, all_programs(), alone(8)));
  EXPECT_TRUE(document::holds(text, "--bind-to none --hostfile " + options.hostfile + " --oversubscribe -n 1"));
  EXPECT_TRUE(document::holds(text, "OMPI_MCA_oob_tcp_keepalive_time=10"));
}

TEST(Command, MachinesOfABatchJobArePassedOn) {
  const test::TemporaryFolder folder;
  const Surroundings job = alone(8, {"LSB_HOSTS=n1 n1 n2 n2 n2"});
  EXPECT_TRUE(document::holds(line(4, job), "--bind-to none --host n1:2,n2:3 --oversubscribe -n 1"));
  options::RenderOptions options = film(0);
  options.backend = options::Backend::mpi;
  EXPECT_EQ(default_nodes(options, job), 4u);
  EXPECT_EQ(cores_in_use(options, job), 5u);
  options.hostfile = write_hostfile(folder, "n3\n").string();
  EXPECT_FALSE(document::holds(shell_text(mpi_command(options, all_programs(), job)), "--host n1"));
  const Surroundings wrong = alone(8, {"PBS_NODEFILE=" + (folder / "gone").string()});
  EXPECT_TRUE(document::holds(document::failure_of([&] { line(4, wrong); }), "PBS_NODEFILE"));
  options.hostfile.clear();
  options.backend = options::Backend::threads;
  EXPECT_EQ(default_nodes(options, wrong), 16u) << "threads need no list";
}

TEST(Command, FoldersOfLibrariesAreHandedOn) {
  const std::string passed = "OMPI_MCA_plm_rsh_pass_libpath=/opt/a/lib:/opt/b/lib ";
  const std::string libraries = "LD_LIBRARY_PATH=/opt/a/lib:/opt/b/lib";
  EXPECT_TRUE(document::holds(line(3, alone(8, {libraries, "LSB_HOSTS=n1"})), passed));
  EXPECT_FALSE(document::holds(line(3, alone(8, {libraries})), "pass_libpath")) << "on this machine all take them over";
  EXPECT_FALSE(document::holds(line(3, alone(8, {"LD_LIBRARY_PATH=/a b;c", "LSB_HOSTS=n1"})), "libpath"));
}

TEST(Command, MpichHasWordsOfItsOwn) {
  const test::TemporaryFolder folder;
  Programs programs = all_programs();
  programs.mpi = Mpi::mpich;
  options::RenderOptions options = film(7);
  const Surroundings surroundings = {2, 2, 0, true, true, true, {"MARS_MEMORY"}, 0, child::Environment({})};
  EXPECT_EQ(shell_text(mpi_command(options, programs, surroundings)),
            "UCX_TLS=sm,self LD_PRELOAD=/opt/mars-loopback.so /usr/bin/mpirun -bind-to none -n 1 /opt/mars-host 'a "
            "film.json' -o out : -n 7 /opt/mars-node");
  options.hostfile = write_hostfile(folder, "n1 slots=2\nn4\n").string();
  EXPECT_TRUE(
      document::holds(shell_text(mpi_command(options, programs, surroundings)), "-bind-to none -hosts n1:2,n4:1 -n 1"));
}

TEST(Command, SlurmsTasksAreCounted) {
  using Tasks = std::vector<std::uint32_t>;
  EXPECT_EQ(tasks_of_machines(""), Tasks());
  EXPECT_EQ(tasks_of_machines("4"), Tasks{4});
  EXPECT_EQ(tasks_of_machines("2(x4)"), (Tasks{2, 2, 2, 2}));
  EXPECT_EQ(tasks_of_machines("2(x3),1,16(x2)"), (Tasks{2, 2, 2, 1, 16, 16}));
  EXPECT_EQ(tasks_of_machines("nonsense"), Tasks());
  EXPECT_LE(tasks_of_machines("1(x4294967295)").size(), 1u << 20);
}

TEST(Command, NodesFillWhatThereIs) {
  const test::TemporaryFolder folder;
  options::RenderOptions options;
  options.backend = options::Backend::mpi;
  EXPECT_EQ(default_nodes(options, alone(4)), 8u) << "a node a processor";
  EXPECT_EQ(default_nodes(options, batch_job(8)), 7u) << "and one task for the host";
  EXPECT_EQ(default_nodes(options, batch_job(1)), 1u);
  options.hostfile = write_hostfile(folder, "n1 slots=2\nn2 slots=2\n").string();
  EXPECT_EQ(default_nodes(options, batch_job(8)), 3u);
  options = {};
  options.backend = options::Backend::threads;
  EXPECT_EQ(default_nodes(options, batch_job(8)), 2u);
}

TEST(Command, AWrongHostfileIsRefusedBeforeMpirunSeesIt) {
  const test::TemporaryFolder folder;
  options::RenderOptions options = film(7);
  options.hostfile = write_hostfile(folder, "n1\nn2 slots=many\n").string();
  const auto starts = [&] { mpi_command(options, all_programs(), alone(8)); };
  EXPECT_TRUE(document::holds(document::failure_of(starts), "hosts:2: slots has no number"));
}

TEST(Command, SlotsStandForTheCoresOfOtherMachines) {
  const test::TemporaryFolder folder;
  options::RenderOptions options;
  options.backend = options::Backend::mpi;
  EXPECT_EQ(cores_in_use(options, alone(4)), 4u);
  EXPECT_EQ(cores_in_use(options, batch_job(16)), 16u);
  options.hostfile = write_hostfile(folder, "n1 slots=2\nn2\n").string();
  EXPECT_EQ(cores_in_use(options, batch_job(16)), 3u);
  options.hostfile = write_hostfile(folder, "n1 slots=2\nlocalhost slots=5000\n").string();
  EXPECT_EQ(cores_in_use(options, alone(4)), 6u) << "how many there are here is known";
  options = {};
  options.backend = options::Backend::threads;
  EXPECT_EQ(cores_in_use(options, batch_job(16)), 2u);
}

TEST(Command, MindsRootContainersAndSettings) {
  const std::string text = line(1, {8, 8, 0, true, true, true, {"MARS_MEMORY"}, 0, child::Environment({})});
  EXPECT_TRUE(document::holds(text, "OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1"));
  EXPECT_TRUE(document::holds(text, "OMPI_MCA_btl_vader_single_copy_mechanism=none"));
  EXPECT_TRUE(document::holds(text, "OMPI_MCA_plm=^rsh"));
  EXPECT_TRUE(document::holds(text, "-x MARS_MEMORY -n 1 /opt/mars-host"));
  EXPECT_TRUE(document::holds(text, ": -x MARS_MEMORY -n 1 /opt/mars-node")) << "each program has its own";
}

TEST(Command, ThreadsAreOneProcess) {
  EXPECT_EQ(shell_text(threads_command(film(3), all_programs())), "/opt/mars-threads 'a film.json' -o out --nodes 3");
}

TEST(Command, AnyWordCanBePasted) {
  const child::Command command{{{"A", "b c"}}, {"x", "", "it's", "$HOME", "a*b", "tab\there", "é"}};
  EXPECT_EQ(shell_text(command), "A='b c' x '' 'it'\\''s' '$HOME' 'a*b' $'tab\\011here' 'é'");
}

TEST(Command, ProgramsAreBesideUsOrInLibexecOrInThePath) {
  const test::TemporaryFolder folder;
  make_program(folder / "bin/mars-host");
  make_program(folder / "libexec/mars-node");
  make_program(folder / "path/mars-threads");
  make_program(folder / "path/mars-host");
  // A name that cannot be looked up, as in another user's folder.
  const std::string unusable = std::string(300, 'x');
  const std::string path = unusable + ":" + (folder / "none").string() + "::" + (folder / "path").string();
  const Programs programs = find_programs(folder / "bin/mars", path);
  EXPECT_EQ(programs.host, folder / "bin/mars-host");
  EXPECT_EQ(programs.node, folder / "libexec/mars-node");
  EXPECT_EQ(programs.threads, folder / "path/mars-threads");
  EXPECT_EQ(programs.mpirun, std::nullopt);
}

TEST(Command, MpirunIsThatOfOurMpi) {
  const test::TemporaryFolder folder;
  for (const char* name :
       {"module/mpirun", "usr/mpirun", "usr/mpirun.openmpi", "usr/mpirun.mpich", "usr/mpiexec.hydra"})
    make_program(folder / name);
  const std::string usr = (folder / "usr").string();
  EXPECT_EQ(find_mpirun(Mpi::open_mpi, usr), folder / "usr/mpirun.openmpi");
  EXPECT_EQ(find_mpirun(Mpi::mpich, usr), folder / "usr/mpirun.mpich");
  EXPECT_EQ(find_mpirun(Mpi::mpich, (folder / "module").string() + ":" + usr), folder / "module/mpirun");
  EXPECT_EQ(find_mpirun(Mpi::mpich, "/none"), std::nullopt);
}

options::Backend chosen(options::Backend asked, const Programs& programs, const std::string& hostfile = "",
                        std::vector<std::string> environment = {}) {
  options::RenderOptions options;
  options.backend = asked;
  options.hostfile = hostfile;
  return choose_backend(options, programs, child::Environment(std::move(environment)));
}

std::string refusal(options::Backend asked, const Programs& programs, const std::string& hostfile = "",
                    const std::vector<std::string>& environment = {}) {
  return document::failure_of([&] { chosen(asked, programs, hostfile, environment); });
}

TEST(Command, AutoTakesMpiWhereItIs) {
  using options::Backend;
  Programs programs = all_programs();
  EXPECT_EQ(chosen(Backend::automatic, programs), Backend::mpi);
  EXPECT_EQ(chosen(Backend::threads, programs), Backend::threads);
  programs.mpirun.reset();
  EXPECT_EQ(chosen(Backend::automatic, programs), Backend::threads);
  EXPECT_EQ(refusal(Backend::mpi, programs),
            "mpirun was not found (load the module of Open MPI, for example module load openmpi, or install it "
            "(Debian: openmpi-bin), or use --backend threads on this machine alone)");
  programs = all_programs();
  programs.node.reset();
  EXPECT_EQ(chosen(Backend::automatic, programs), Backend::threads);
  EXPECT_TRUE(document::holds(refusal(Backend::mpi, programs), "mars-host and mars-node"));
  programs.threads.reset();
  EXPECT_TRUE(document::holds(refusal(Backend::automatic, programs), "mars-threads was not"));
}

// Whatever of MPI is missing: threads would use this machine and say nothing of the others.
TEST(Command, NoThreadsWhereOtherMachinesAreAskedFor) {
  using options::Backend;
  const test::TemporaryFolder folder;
  const std::string others = write_hostfile(folder, "localhost\nn2\n").string();
  Programs programs = all_programs();
  programs.mpirun.reset();
  EXPECT_EQ(refusal(Backend::automatic, programs, others),
            "mpirun was not found, and " + others +
                " names other machines (load the module of Open MPI, for example module load openmpi, or install it "
                "(Debian: openmpi-bin))");
  const std::vector<std::string> allocation = {"SLURM_JOB_NUM_NODES=4"};
  EXPECT_TRUE(document::holds(refusal(Backend::automatic, programs, "", allocation),
                              "and the Slurm job has 4 machines (load the module"));
  EXPECT_EQ(chosen(Backend::threads, programs, "", allocation), Backend::threads);
  programs.mpirun = "/usr/bin/mpirun";
  programs.host.reset();
  EXPECT_TRUE(document::holds(refusal(Backend::automatic, programs, others), "mars-host and mars-node were not"));
}

}  // namespace
}  // namespace mars::launch
