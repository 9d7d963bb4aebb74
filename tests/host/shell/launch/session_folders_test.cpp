// Folders of jobs, as the environment wants them and as their locks say that they live.
#include "host/shell/launch/session_folders.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <stdlib.h>
#include <sys/file.h>
#include <sys/mman.h>
#include <unistd.h>

#include <array>
#include <fstream>
#include <optional>
#include <random>
#include <string>

#include "host/content/document/text.h"
#include "tests/temporary_folder.h"

namespace mars::launch {
namespace {

namespace fs = std::filesystem;

constexpr const char* kTemporary = "OMPI_MCA_orte_tmpdir_base";
constexpr std::array kShared = {"OMPI_MCA_btl_vader_backing_directory", "OMPI_MCA_osc_sm_backing_directory"};

constexpr const char* kLocalRank = "OMPI_COMM_WORLD_LOCAL_RANK";
constexpr const char* kSession = "OMPI_MCA_orte_jobfam_session_dir";

child::Command open_mpi() { return {{}, {"mpirun"}, child::OpenMpi::on_this_machine}; }

std::optional<fs::path> folder_for(const char* setting, const child::Command& command) {
  for (const auto& [name, value] : command.environment)
    if (name == setting) return value;
  return std::nullopt;
}

class SessionFoldersTest : public testing::Test {
 protected:
  SessionFoldersTest() {
    for (const char* name : {kTemporary, kShared[0], kShared[1], "TEMP", "TMP"}) unsetenv(name);
    setenv("TMPDIR", base_.path().c_str(), 1);
  }
  ~SessionFoldersTest() override {
    for (const char* name : {"TMPDIR", "TMP", kLocalRank, kSession}) unsetenv(name);
  }

  static void begin_as_rank(const char* number_here, const fs::path& session) {
    setenv(kLocalRank, number_here, 1);
    setenv(kSession, session.c_str(), 1);
    clean_machine_as_rank();
  }

  // As Open MPI names it for a user of a machine.
  static std::string machine_and_user(const std::string& host = "") {
    std::array<char, 256> here{};
    gethostname(here.data(), here.size() - 1);
    const std::string name = host.empty() ? here.data() : host;
    return name.substr(0, name.find('.')) + "." + std::to_string(geteuid());
  }

  static fs::path write(const fs::path& file) {
    fs::create_directories(file.parent_path());
    std::ofstream(file) << "shared";
    return file;
  }

  bool base_is_empty() const { return fs::is_empty(base_.path()); }

  const test::TemporaryFolder base_;
};

TEST_F(SessionFoldersTest, ArePartOfTheCommandAndGo) {
  child::Command command = open_mpi();
  {
    const SessionFolders folders(command);
    EXPECT_EQ(folder_for(kTemporary, command)->parent_path(), base_.path());
    EXPECT_TRUE(fs::is_directory(*folder_for(kTemporary, command)));
    EXPECT_EQ(folder_for(kShared[0], command)->parent_path(), "/dev/shm");
    EXPECT_EQ(folder_for(kShared[0], command), folder_for(kShared[1], command));
  }
  EXPECT_TRUE(base_is_empty());
  EXPECT_FALSE(fs::exists(*folder_for(kShared[0], command)));
}

TEST_F(SessionFoldersTest, OnSeveralMachinesThereAreNoneAndWhatAKilledMpirunLeftGoes) {
  child::Command command{{}, {"mpirun"}, child::OpenMpi::on_several};
  const SessionFolders none(command);
  EXPECT_TRUE(command.environment.empty());
  const auto segment = [](unsigned job) {
    const std::string name = document::formatted("vader_segment.here.%u.%x.0", geteuid(), job);
    std::ofstream(fs::path("/dev/shm") / name) << "shared";
    return fs::path("/dev/shm") / name;
  };
  const unsigned job = std::random_device()() << 2;  // no other test's, which would be in the same folder
  const fs::path its = segment(job + 1), others = segment(job + 2);
  const fs::path sessions = base_.path() / "ompi.here.0";
  for (const char* of : {"pid.7", "pid.8"}) fs::create_directories(sessions / of);
  std::ofstream(sessions / "pid.7/contact.txt") << job << ".0;tcp://192.0.2.1:7\n7\n";
  remove_session_of(7);
  EXPECT_FALSE(fs::exists(its));
  EXPECT_FALSE(fs::exists(sessions / "pid.7"));
  EXPECT_TRUE(fs::exists(sessions / "pid.8"));
  EXPECT_TRUE(fs::remove(others));
}

TEST_F(SessionFoldersTest, AnEmptyTmpdirIsNone) {
  setenv("TMPDIR", "", 1);
  setenv("TMP", base_.path().c_str(), 1);
  child::Command command = open_mpi(), threads{{}, {"mars-threads"}};
  const SessionFolders folders(command), none(threads);
  EXPECT_EQ(folder_for(kTemporary, command)->parent_path(), base_.path());
  EXPECT_TRUE(threads.environment.empty());
}

TEST_F(SessionFoldersTest, OfARelativeTmpdirAreNamedInFull) {
  const fs::path before = fs::current_path();
  fs::current_path(base_.path());
  setenv("TMPDIR", ".", 1);
  child::Command command = open_mpi();
  {
    const SessionFolders folders(command);
    EXPECT_TRUE(folder_for(kTemporary, command)->is_absolute());
    EXPECT_FALSE(base_is_empty());
  }
  fs::current_path(before);
  EXPECT_TRUE(base_is_empty());
}

TEST_F(SessionFoldersTest, AreNotMadeWhereAPersonNamedOthers) {
  setenv(kTemporary, "/elsewhere", 1);
  setenv(kShared[0], "/elsewhere", 1);
  child::Command command = open_mpi();
  const SessionFolders folders(command);
  EXPECT_TRUE(base_is_empty());
  ASSERT_EQ(command.environment.size(), 1u);
  EXPECT_EQ(command.environment[0].first, kShared[1]);
}

TEST_F(SessionFoldersTest, OfALivingJobStayAndOfAnEndedOneGo) {
  child::Command first = open_mpi(), second = open_mpi();
  const SessionFolders living(first);
  const fs::path lives = *folder_for(kTemporary, first);
  const fs::path ended = lives.string().substr(0, lives.string().size() - 6) + "abcdef";
  fs::create_directories(ended / "session");
  const int lock = open(ended.c_str(), O_RDONLY | O_DIRECTORY);
  ASSERT_EQ(flock(lock, LOCK_SH), 0);
  { const SessionFolders next(second); }
  EXPECT_TRUE(fs::exists(lives));
  EXPECT_TRUE(fs::exists(ended)) << "its lock is taken";
  close(lock);
  { const SessionFolders next(second); }
  EXPECT_TRUE(fs::exists(lives));
  EXPECT_FALSE(fs::exists(ended));
}

TEST_F(SessionFoldersTest, WhatWasKilledLeavesNothingToTheNextJobsFirstRank) {
  const fs::path sessions = base_.path() / ("ompi." + machine_and_user());
  const fs::path dead = write(sessions / "jf.7/hwloc.sm"), ours = write(sessions / "jf.70/hwloc.sm"),
                 mapped = write(sessions / "pid.8/pmix_dstor_ds21_8/smseg-0"), begun = sessions / "jf.9/0",
                 others = write(base_.path() / ("ompi." + machine_and_user("elsewhere")) / "jf.7/hwloc.sm");
  fs::create_directories(begun);
  fs::create_directory_symlink(others.parent_path(), sessions / "jf.10");
  const int held = open(ours.c_str(), O_RDONLY), brief = open(mapped.c_str(), O_RDONLY);
  void* memory = mmap(nullptr, 6, PROT_READ, MAP_SHARED, brief, 0);
  close(brief);
  begin_as_rank("1", ours.parent_path());
  EXPECT_TRUE(fs::exists(dead)) << "another rank removes it";
  begin_as_rank("0", dead.parent_path());
  EXPECT_TRUE(fs::exists(dead)) << "who does not see its own job's files sees nobody's";
  begin_as_rank("0", ours.parent_path());
  EXPECT_FALSE(fs::exists(dead.parent_path()));
  for (const fs::path& living : {ours, mapped, begun, others}) EXPECT_TRUE(fs::exists(living)) << living;
  munmap(memory, 6);
  begin_as_rank("0", ours.parent_path());
  EXPECT_FALSE(fs::exists(mapped.parent_path().parent_path()));
  for (const fs::path& living : {ours, begun, others}) EXPECT_TRUE(fs::exists(living)) << living;
  close(held);
}

TEST_F(SessionFoldersTest, SharedMemoryGoesUnlessAProcessHoldsIt) {
  const std::string job = std::to_string(std::random_device()());  // no other test's, which would be in the same folder
  const auto segment = [&](const std::string& owner, const char* rank) {
    return write("/dev/shm/vader_segment." + owner + "." + job + "." + rank);
  };
  const fs::path dead = segment(machine_and_user(), "1"), others = segment(machine_and_user("elsewhere"), "1");
  const fs::path living = segment(machine_and_user(), "10");
  const fs::path session = write(base_.path() / ("ompi." + machine_and_user()) / "pid.5/hwloc.sm");
  const int held = open(living.c_str(), O_RDONLY), ours = open(session.c_str(), O_RDONLY);
  begin_as_rank("0", session.parent_path());
  EXPECT_FALSE(fs::exists(dead));
  for (const int file : {held, ours}) close(file);
  for (const fs::path& stays : {living, others}) EXPECT_TRUE(fs::remove(stays)) << stays;
}

}  // namespace
}  // namespace mars::launch
