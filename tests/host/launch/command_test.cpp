#include "host/launch/command.h"

#include <gtest/gtest.h>

#include <fstream>

#include "tests/host/document/failure_of.h"
#include "tests/host/sinks/temporary_folder.h"

namespace mars::host {
namespace {

namespace fs = std::filesystem;

Programs all_programs() {
  return {"/usr/bin/mpirun", "/opt/mars-host", "/opt/mars-node", "/opt/mars-threads"};
}

RenderOptions film(std::uint32_t nodes) {
  RenderOptions options;
  options.film = "a film.json";
  options.folder = "out";
  options.nodes = nodes;
  return options;
}

std::string line(std::uint32_t nodes, const Surroundings& surroundings) {
  return shell_text(mpi_command(film(nodes), all_programs(), surroundings));
}

void make_program(const fs::path& file) {
  fs::create_directories(file.parent_path());
  std::ofstream(file) << "#!/bin/sh\n";
  fs::permissions(file, fs::perms::owner_all);
}

TEST(Command, OneHostAndItsNodes) {
  EXPECT_EQ(
      line(3, {8, false, false, false, {}}),
      "PMIX_MCA_gds=hash /usr/bin/mpirun --bind-to none -n 1 /opt/mars-host 'a film.json' -o out : -n 3 "
      "/opt/mars-node");
}

TEST(Command, OversubscribesWhereHostAndNodesExceedTheCores) {
  EXPECT_FALSE(holds(line(3, {4, false, false, false, {}}), "--oversubscribe"));
  EXPECT_TRUE(holds(line(4, {4, false, false, false, {}}), "--bind-to none --oversubscribe -n 1"));
}

TEST(Command, MindsRootContainersAndSettings) {
  const std::string text = line(1, {8, true, true, true, {"MARS_MEMORY"}});
  EXPECT_TRUE(holds(text, "OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1"));
  EXPECT_TRUE(holds(text, "OMPI_MCA_btl_vader_single_copy_mechanism=none"));
  EXPECT_TRUE(holds(text, "OMPI_MCA_plm=^rsh"));
  EXPECT_TRUE(holds(text, "-x MARS_MEMORY -n 1"));
}

TEST(Command, ThreadsAreOneProcess) {
  EXPECT_EQ(shell_text(threads_command(film(3), all_programs())),
            "/opt/mars-threads 'a film.json' -o out --nodes 3");
}

TEST(Command, AnyWordCanBePasted) {
  const Command command{{{"A", "b c"}}, {"x", "", "it's", "$HOME", "a*b", "tab\there", "é"}};
  EXPECT_EQ(shell_text(command), "A='b c' x '' 'it'\\''s' '$HOME' 'a*b' 'tab\there' 'é'");
}

TEST(Command, ProgramsAreBesideUsOrInLibexecOrInThePath) {
  const TemporaryFolder folder;
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

TEST(Command, AutoTakesMpiWhereItIs) {
  Programs programs = all_programs();
  EXPECT_EQ(choose_backend(Backend::automatic, programs), Backend::mpi);
  EXPECT_EQ(choose_backend(Backend::threads, programs), Backend::threads);
  programs.mpirun.reset();
  EXPECT_EQ(choose_backend(Backend::automatic, programs), Backend::threads);
  EXPECT_TRUE(holds(failure_of([&] { choose_backend(Backend::mpi, programs); }), "mpirun was not found"));
  programs = all_programs();
  programs.node.reset();
  EXPECT_EQ(choose_backend(Backend::automatic, programs), Backend::threads);
  EXPECT_TRUE(holds(failure_of([&] { choose_backend(Backend::mpi, programs); }), "mars-host and mars-node"));
  programs.threads.reset();
  EXPECT_TRUE(
      holds(failure_of([&] { choose_backend(Backend::automatic, programs); }), "mars-threads was not"));
}

}  // namespace
}  // namespace mars::host
