#include "host/shell/batch/batch_script.h"

#include <gtest/gtest.h>

namespace mars::batch {
namespace {

constexpr const char* kTemplate = R"(#!/bin/bash
#SBATCH --nodes=4
#SBATCH --signal=B:USR1@120
# Renders.
film=(mars render "$@")
exit
)";

TEST(BatchScript, ReplacesTheOptionsThatAreGiven) {
  const BatchJob job{{{"nodes", "2"}, {"time", "1:00"}}, {}, {"film.json", "-o", "out"}, {}, "/opt/mars/bin"};
  EXPECT_EQ(batch_script(kTemplate, job), R"(#!/bin/bash
#SBATCH --signal=B:USR1@120
#SBATCH --nodes=2
#SBATCH --time=1:00
# Renders.
PATH=/opt/mars/bin:$PATH
set -- film.json -o out
film=(mars render "$@")
exit
)");
}

TEST(BatchScript, QuotesWhatAShellWouldReadOtherwise) {
  const BatchJob job{{}, {}, {"my film.json", "-o", "it's"}, {}, "/a b"};
  const std::string script = batch_script(kTemplate, job);
  EXPECT_NE(script.find("PATH='/a b':$PATH\n"), std::string::npos) << script;
  EXPECT_NE(script.find("set -- 'my film.json' -o "), std::string::npos) << script;
}

TEST(BatchScript, GivesEachTaskOfAnArrayItsFrames) {
  const BatchJob job{{}, {}, {"film.json"}, {film::FrameSet("0-9"), film::FrameSet("10-30,40")}, "/bin"};
  const std::string script = batch_script(kTemplate, job);
  EXPECT_NE(script.find("#SBATCH --array=0-1\n"), std::string::npos) << script;
  EXPECT_NE(script.find("frames=(0-9 10-30,40)\nset -- film.json --frames \"${frames[SLURM_ARRAY_TASK_ID]}\"\n"),
            std::string::npos)
      << script;
}

TEST(BatchScript, NamesWhatElseSbatchGets) {
  const BatchJob job{{{"nodes", "2"}}, {"--qos=high", "--comment=two words"}, {"film.json"}, {}, "/bin"};
  const std::string script = batch_script(kTemplate, job);
  EXPECT_NE(script.find("#SBATCH --nodes=2\n# mars submit calls sbatch with: --qos=high '--comment=two words'\n"),
            std::string::npos)
      << script;
}

TEST(BatchScript, OfOnePartIsNoArray) {
  const BatchJob job{{}, {}, {"film.json"}, {film::FrameSet("0-9")}, "/bin"};
  const std::string script = batch_script(kTemplate, job);
  EXPECT_EQ(script.find("array"), std::string::npos) << script;
  EXPECT_NE(script.find("set -- film.json --frames 0-9\n"), std::string::npos) << script;
}

}  // namespace
}  // namespace mars::batch
