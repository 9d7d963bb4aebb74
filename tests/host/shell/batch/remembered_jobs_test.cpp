#include "host/shell/batch/remembered_jobs.h"

#include <gtest/gtest.h>

#include "host/content/document/file.h"
#include "host/content/document/whole_file.h"
#include "tests/host/content/document/failure_of.h"
#include "tests/temporary_folder.h"

namespace mars::batch {
namespace {

using Numbers = std::vector<std::string>;

TEST(RememberedJobs, AreThoseThatWereAdded) {
  const test::TemporaryFolder folder;
  const RememberedJobs jobs(folder / "out");
  EXPECT_EQ(jobs.numbers(), Numbers{});
  EXPECT_EQ(document::read_file(jobs.write_script("sleep 1\n")), "sleep 1\n");
  jobs.add("12");
  jobs.add("15");
  EXPECT_EQ(RememberedJobs(folder / "out").numbers(), (Numbers{"12", "15"}));
}

TEST(RememberedJobs, AreRefusedWhereTheFileIsDamaged) {
  const test::TemporaryFolder folder;
  const RememberedJobs jobs(folder.path());
  jobs.write_script("");
  for (const char* text : {"{", "{}", R"({"jobs": [{"job": 12}]})", R"({"jobs": [{"job": "12; rm"}]})"}) {
    document::write_whole_file(folder / ".slurm/jobs.json", std::string_view(text));
    EXPECT_TRUE(document::holds(document::failure_of([&] { jobs.numbers(); }), "not a list of jobs")) << text;
  }
}

TEST(RememberedJobs, PrintToFilesOfTheirOwn) {
  EXPECT_EQ(RememberedJobs("/a 50%").output_pattern(false), "/a 50%%/.slurm/%j.out");
  EXPECT_EQ(RememberedJobs("/a").output_pattern(true), "/a/.slurm/%A_%a.out");
}

}  // namespace
}  // namespace mars::batch
