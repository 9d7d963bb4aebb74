#include "host/shell/batch/queued_jobs.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "tests/host/content/document/failure_of.h"
#include "tests/temporary_folder.h"

namespace mars::batch {
namespace {

std::optional<QueuedJob> read_by(std::size_t system, const std::string& line) {
  return queued_job_of(batch_systems()[system], line);
}

TEST(QueuedJob, IsReadFromALineOfSqueue) {
  EXPECT_EQ(read_by(0, "12_3|RUNNING|1:02:03|2|n[1-4]|None|"),
            (QueuedJob{"12_3", "running", "1:02:03", 2, "n[1-4]", ""}));
  EXPECT_EQ(document::failure_of([] { read_by(0, "slurm is down"); }),
            "squeue's answer is not understood: slurm is down");
}

TEST(QueuedJob, IsReadFromLinesOfOtherSystems) {
  EXPECT_EQ(read_by(1, "123.pbs          mars             ada               00:00:20 R workq"),
            (QueuedJob{"123.pbs", "running", "00:00:20", 0, "", ""}));
  EXPECT_EQ(read_by(2, "123|PEND|0 second(s)|-|Job is waiting|"),
            (QueuedJob{"123", "pending", "0 second(s)", 0, "", "Job is waiting"}));
  EXPECT_EQ(read_by(3, "f2abc|RUN|20.5s|n[1-2]|"), (QueuedJob{"f2abc", "running", "20.5s", 0, "n[1-2]", ""}));
}

TEST(QueuedJob, IsNoneWhereItHasEnded) {
  EXPECT_EQ(read_by(1, "123.pbs  mars  ada  00:00:20 C workq"), std::nullopt);
  EXPECT_EQ(read_by(2, "123|DONE|20 second(s)|n1|-|"), std::nullopt);
  EXPECT_EQ(read_by(3, "f2abc|INACTIVE|20.5s|n[1-2]|"), std::nullopt);
}

TEST(QueuedJob, SaysWhereItRunsOrWhyItWaits) {
  EXPECT_EQ(text_of({"12", "running", "0:20", 0, "n[1-4]", ""}), "job 12: running on n[1-4] for 0:20");
  EXPECT_EQ(text_of({"12", "running", "0:20", 0, "", ""}), "job 12: running for 0:20");
  EXPECT_EQ(text_of({"12", "pending", "0:00", 1, "", "Resources"}), "job 12: pending (Resources), 1 restart");
  EXPECT_EQ(text_of({"12", "pending", "0:00", 2, "", ""}), "job 12: pending, 2 restarts");
}

// The program printf answers in place of qstat.
std::string failure_of_answer(const std::vector<std::string>& lines) {
  BatchSystem system = batch_systems()[1];
  system.list = {"printf", "%s\\n"};
  system.list.insert(system.list.end(), lines.begin(), lines.end());
  return document::failure_of([&] { EXPECT_EQ(queued_jobs({{&system, {"1"}}}).size(), 1u); });
}

TEST(QueuedJobs, AreUnknownWhereTheAnswerIsAnother) {
  const std::string header = "Job id    Name  User  Time Use S Queue",
                    dashes = "--------- ----- ----- -------- - -----";
  EXPECT_EQ(failure_of_answer({header, dashes, "1.pbs mars ada 00:00:20 R workq"}), "");
  EXPECT_EQ(failure_of_answer({"[]"}), "printf's answer is not understood: []");
  EXPECT_EQ(failure_of_answer({"12"}), "printf's answer is not understood: 12");
  EXPECT_EQ(failure_of_answer({"{", "  \"Jobs\": [", "    1", "  ]", "}"}), "printf's answer is not understood: {");
  EXPECT_EQ(failure_of_answer({header, dashes, "1.pbs mars ada 00:00:20 7 workq"}),
            "printf's answer is not understood: 1.pbs mars ada 00:00:20 7 workq");
}

TEST(QueuedJobs, AreUnknownWhereAProgramHangs) {
  constexpr std::chrono::milliseconds kLimit{50};
  BatchSystem system = batch_systems()[2];
  system.list = system.cancel = system.submit = {"sh", "-c", "echo 1; exec sleep 1000"};
  const std::vector<Jobs> jobs = {{&system, {"1"}}};
  EXPECT_TRUE(document::failure_of([&] { queued_jobs(jobs, kLimit); }).starts_with("sh has not answered for 0.05 sec"));
  EXPECT_THROW(cancel_jobs(jobs, kLimit), NoAnswer);
  EXPECT_TRUE(document::failure_of([&] { submit_job(system, {}, kLimit); }).starts_with("bsub has not answered for "));
}

TEST(Doubts, AreLeftOutWhereSinfoHangs) {
  const test::TemporaryFolder folder;
  const std::filesystem::path sinfo = folder / "sinfo";
  const std::string before = std::getenv("PATH");
  setenv("PATH", (folder.path().string() + ":" + before).c_str(), 1);
  const auto doubts = [&](const std::string& end, std::chrono::milliseconds longest) {
    std::ofstream(sinfo) << "#!/bin/sh\necho 'main*|1|0/8/0/8'; " << end << "\n";
    std::filesystem::permissions(sinfo, std::filesystem::perms::owner_all);
    return doubts_of(batch_systems()[0], {}, longest).size();
  };
  EXPECT_EQ(doubts("exit", kLongestAnswer), 1u);
  EXPECT_EQ(doubts("exec sleep 1000", std::chrono::milliseconds(50)), 0u);
  setenv("PATH", before.c_str(), 1);
}

TEST(JobNumber, IsOneWordThatIsNoOption) {
  for (const char* number : {"12", "123.pbs", "123[].pbs",
                             "\xC6\x92"
                             "2abc"})
    EXPECT_TRUE(is_job_number(number)) << number;
  for (const char* number : {"", "-12", "12; rm", "1,2", "1\n2"}) EXPECT_FALSE(is_job_number(number)) << number;
}

}  // namespace
}  // namespace mars::batch
