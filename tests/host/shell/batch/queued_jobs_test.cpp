#include "host/shell/batch/slurm.h"

#include <gtest/gtest.h>

#include "tests/host/content/document/failure_of.h"

namespace mars::batch {
namespace {

TEST(QueuedJob, IsReadFromALineOfSqueue) {
  EXPECT_EQ(queued_job_of("12_3|RUNNING|1:02:03|2|n[1-4]|None|"),
            (QueuedJob{"12_3", "RUNNING", "1:02:03", 2, "n[1-4]", "None"}));
  EXPECT_EQ(document::failure_of([] { queued_job_of("slurm is down"); }),
            "squeue's answer is not understood: slurm is down");
}

TEST(QueuedJob, SaysWhereItRunsOrWhyItWaits) {
  EXPECT_EQ(text_of({"12", "RUNNING", "0:20", 0, "n[1-4]", "None"}), "job 12: running on n[1-4] for 0:20");
  EXPECT_EQ(text_of({"12", "PENDING", "0:00", 1, "", "Resources"}), "job 12: pending (Resources), 1 restart");
  EXPECT_EQ(text_of({"12", "PENDING", "0:00", 2, "", "None"}), "job 12: pending, 2 restarts");
}

}  // namespace
}  // namespace mars::batch
