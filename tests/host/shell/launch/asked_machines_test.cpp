#include "host/shell/launch/asked_machines.h"

#include <gtest/gtest.h>

#include <fstream>

#include "tests/temporary_folder.h"

namespace mars::launch {
namespace {

std::string asked_by(std::vector<std::string> environment) {
  return asked_machines("", child::Environment(std::move(environment)));
}

class AskedMachines : public testing::Test {
 protected:
  std::string file(const std::string& text) {
    std::ofstream(folder_ / "machines") << text;
    return (folder_ / "machines").string();
  }

  const test::TemporaryFolder folder_;
};

TEST_F(AskedMachines, OfAHostfileCountIfTheyAreOthers) {
  const child::Environment nothing({});
  EXPECT_EQ(asked_machines(file("localhost slots=8\n"), nothing), "");
  EXPECT_EQ(asked_machines(file("localhost\nn2\n"), nothing), file("") + " names other machines");
  EXPECT_EQ(asked_machines(file("+n1\n"), nothing), file("") + " names other machines") << "whichever that is";
  EXPECT_EQ(asked_machines(file("localhost\n"), child::Environment({"SLURM_JOB_NUM_NODES=4"})), "");
}

TEST_F(AskedMachines, OfASlurmJob) {
  EXPECT_EQ(asked_by({}), "");
  EXPECT_EQ(asked_by({"SLURM_JOB_NUM_NODES=4", "SLURMD_NODENAME=n1"}), "the Slurm job has 4 machines");
  EXPECT_EQ(asked_by({"SLURM_JOB_NUM_NODES=1", "SLURM_JOB_NODELIST=localhost"}), "");
  EXPECT_EQ(asked_by({"SLURM_JOB_NUM_NODES=1", "SLURM_JOB_NODELIST=n7"}), "the Slurm job has the machine n7");
  EXPECT_EQ(asked_by({"SLURM_JOB_NUM_NODES=1", "SLURM_JOB_NODELIST=n7", "SLURMD_NODENAME=n7"}), "")
      << "this is n7, by another name";
}

TEST_F(AskedMachines, OfOtherBatchJobs) {
  const std::string twice = "n1\nn1\n", both = twice + "n2\n";
  EXPECT_EQ(asked_by({"PBS_NODEFILE=" + file(twice)}), "");
  EXPECT_EQ(asked_by({"PBS_NODEFILE=" + file(both)}), "PBS_NODEFILE has 2 machines");
  EXPECT_EQ(asked_by({"PE_HOSTFILE=" + file("n1 4 all.q\nn2 4 all.q\nn3 2 all.q\n")}), "PE_HOSTFILE has 3 machines");
  EXPECT_EQ(asked_by({"LSB_HOSTS=n1 n1 n1"}), "");
  EXPECT_EQ(asked_by({"LSB_MCPU_HOSTS=n1 4 n2 4"}), "LSB_MCPU_HOSTS has 2 machines");
  EXPECT_EQ(asked_by({"LSB_MCPU_HOSTS=n1 4"}), "");
  EXPECT_EQ(asked_by({"PBS_NODEFILE=/none"}), "");
}

TEST_F(AskedMachines, BatchJobsListThem) {
  EXPECT_FALSE(batch_lists_machines(child::Environment({"SLURM_JOB_NUM_NODES=4"})));
  EXPECT_TRUE(batch_lists_machines(child::Environment({"LSB_HOSTS=n1"})));
}

}  // namespace
}  // namespace mars::launch
