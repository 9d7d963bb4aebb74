#include "host/shell/launch/asked_machines.h"

#include <gtest/gtest.h>

#include <fstream>

#include "tests/host/content/document/failure_of.h"
#include "tests/temporary_folder.h"

namespace mars::launch {
namespace {

std::string asked_by(std::vector<std::string> environment) {
  return asked_machines("", child::Environment(std::move(environment)));
}

std::vector<Slots> named_by(std::vector<std::string> environment) {
  return named_machines("", child::Environment(std::move(environment)));
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
  EXPECT_EQ(asked_by({"SLURM_NNODES=3", "SLURMD_NODENAME=n1"}), "the Slurm job has 3 machines");
}

TEST_F(AskedMachines, OfAFluxJob) {
  EXPECT_EQ(asked_by({"FLUX_JOB_ID=f12", "FLUX_JOB_NNODES=3"}), "the Flux job has 3 machines");
  EXPECT_EQ(asked_by({"FLUX_JOB_ID=f12", "FLUX_JOB_NNODES=1"}), "");
}

TEST_F(AskedMachines, OfOtherBatchJobs) {
  const std::string twice = "n1\nn1\n", both = twice + "n2\n";
  EXPECT_EQ(asked_by({"PBS_NODEFILE=" + file(twice)}), "");
  EXPECT_EQ(asked_by({"PBS_NODEFILE=" + file(both)}), "PBS_NODEFILE has 2 machines");
  EXPECT_EQ(asked_by({"PE_HOSTFILE=" + file("n1 4 all.q\nn2 4 all.q\nn3 2 all.q\n")}), "PE_HOSTFILE has 3 machines");
  EXPECT_EQ(asked_by({"LSB_HOSTS=n1 n1 n1"}), "");
  EXPECT_EQ(asked_by({"LSB_MCPU_HOSTS=n1 4 n2 4"}), "LSB_MCPU_HOSTS has 2 machines");
  EXPECT_EQ(asked_by({"LSB_MCPU_HOSTS=n1 4"}), "");
  EXPECT_EQ(asked_by({"PBS_NODEFILE="}), "");
}

TEST_F(AskedMachines, ABatchJobNamesThemWithTheirSlots) {
  const std::vector<Slots> both = {{"n1", 2}, {"n2", 1}};
  EXPECT_EQ(named_by({"PBS_NODEFILE=" + file("n1\nn2\n\nn1\n")}), both);
  EXPECT_EQ(named_by({"PE_HOSTFILE=" + file("n1 2 all.q@n1 <NULL>\nn0 0 all.q\nn2 1 all.q UNDEFINED\n")}), both);
  EXPECT_EQ(named_by({"LSB_DJOB_HOSTFILE=" + file("n1\nn1\nn2")}), both);
  EXPECT_EQ(named_by({"LSB_HOSTS=n1 n2 n1"}), both);
  EXPECT_EQ(named_by({"LSB_MCPU_HOSTS=n1 2 n2 1 "}), both);
  EXPECT_EQ(named_by({"LSB_MCPU_HOSTS=n1 4294967295 n1 4294967295 n2"}),
            (std::vector<Slots>{{"n1", 999999}, {"n2", 1}}));
}

TEST_F(AskedMachines, NamedAreOnlySeveralAndNotThoseOfSlurm) {
  EXPECT_EQ(named_by({}), std::vector<Slots>());
  EXPECT_EQ(named_by({"LSB_HOSTS=n1 n1"}), std::vector<Slots>());
  EXPECT_EQ(named_by({"PBS_NODEFILE=" + file("")}), std::vector<Slots>());
  EXPECT_EQ(named_by({"LSB_HOSTS=n1 n2", "SLURM_JOB_ID=3"}), std::vector<Slots>()) << "mpirun asks Slurm";
  const child::Environment job({"LSB_HOSTS=n1 n2"});
  EXPECT_EQ(named_machines(file("n3 slots=2\n"), job), (std::vector<Slots>{{"n3", 2}}));
  EXPECT_EQ(named_machines(file("+n1\n"), job), std::vector<Slots>()) << "mpirun alone knows it";
}

TEST_F(AskedMachines, AListThatCannotBeReadIsNamed) {
  const std::string list = "PBS_NODEFILE=" + (folder_ / "gone").string();
  for (const std::string& failure :
       {document::failure_of([&] { named_by({list}); }), document::failure_of([&] { asked_by({list}); })}) {
    EXPECT_TRUE(document::holds(failure, "gone: the machines of the job cannot be read from PBS_NODEFILE: "))
        << failure;
    EXPECT_TRUE(document::holds(failure, "or unset PBS_NODEFILE")) << failure;
  }
}

TEST_F(AskedMachines, BatchJobsListThem) {
  EXPECT_FALSE(batch_lists_machines(child::Environment({"SLURM_JOB_NUM_NODES=4"})));
  EXPECT_TRUE(batch_lists_machines(child::Environment({"LSB_HOSTS=n1"})));
}

}  // namespace
}  // namespace mars::launch
