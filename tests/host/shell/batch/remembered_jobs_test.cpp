#include "host/shell/batch/remembered_jobs.h"

#include <gtest/gtest.h>

#include "host/content/document/file.h"
#include "host/content/document/whole_file.h"
#include "tests/host/content/document/failure_of.h"
#include "tests/temporary_folder.h"

namespace mars::batch {
namespace {

using Numbers = std::vector<std::string>;

const BatchSystem& first() { return batch_systems()[0]; }

TEST(RememberedJobs, AreThoseThatWereAdded) {
  const test::TemporaryFolder folder;
  const RememberedJobs jobs(folder / "out", first());
  EXPECT_EQ(jobs.numbers(), Numbers{});
  jobs.write_script("sleep 1\n");
  EXPECT_EQ(document::read_file(folder / "out/.slurm/job.sbatch"), "sleep 1\n");
  jobs.add("12");
  jobs.add("15");
  EXPECT_EQ(RememberedJobs(folder / "out", first()).numbers(), (Numbers{"12", "15"}));
}

TEST(RememberedJobs, AreAlsoThoseThatJobsSubmitted) {
  const test::TemporaryFolder folder;
  const RememberedJobs jobs(folder.path(), batch_systems()[1]);
  jobs.write_script("");
  jobs.add("12.pbs");
  document::write_whole_file(folder / ".pbs/again", std::string_view("13.pbs\n-x\n14"));
  document::write_whole_file(folder / ".pbs/film.starts", std::string_view("7 3\n"));
  EXPECT_EQ(jobs.numbers(), (Numbers{"12.pbs", "13.pbs"}));
  jobs.add("15.pbs");
  EXPECT_EQ(jobs.numbers(), (Numbers{"12.pbs", "15.pbs", "13.pbs"}));
  jobs.write_script("");
  EXPECT_FALSE(std::filesystem::exists(folder / ".pbs/film.starts"));
  RememberedJobs(folder.path(), first()).write_script("");
  RememberedJobs(folder.path(), first()).add("7");
  const std::vector<Jobs> all = jobs_of(folder.path());
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].numbers, Numbers{"7"});
  EXPECT_EQ(all[1].system->name, "PBS");
}

TEST(RememberedJobs, AreRefusedWhereTheFileIsDamaged) {
  const test::TemporaryFolder folder;
  const RememberedJobs jobs(folder.path(), first());
  jobs.write_script("");
  for (const char* text : {"{", "{}", R"({"jobs": [{"job": 12}]})", R"({"jobs": [{"job": "12; rm"}]})"}) {
    document::write_whole_file(folder / ".slurm/jobs.json", std::string_view(text));
    EXPECT_TRUE(document::holds(document::failure_of([&] { jobs.numbers(); }), "not a list of jobs")) << text;
  }
}

}  // namespace
}  // namespace mars::batch
