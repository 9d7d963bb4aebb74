#include "host/shell/doctor/facts.h"

#include <gtest/gtest.h>
#include <pthread.h>

namespace mars::host {
namespace {

int forks = 0;

TEST(Facts, StartNoProcessWhileAJobIsWaitedFor) {
  pthread_atfork([] { ++forks; }, nullptr, nullptr);
  gather_facts("/proc/self/exe", 1, Ask::no_programs);
  EXPECT_EQ(forks, 0);
  gather_facts("/proc/self/exe", 1, Ask::programs);
  EXPECT_GT(forks, 0) << "or the test sees none";
}

}  // namespace
}  // namespace mars::host
