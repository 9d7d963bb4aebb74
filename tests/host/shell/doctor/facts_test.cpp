#include "host/shell/doctor/facts.h"

#include <gtest/gtest.h>
#include <pthread.h>

namespace mars::doctor {
namespace {

int forks = 0;

TEST(Facts, StartNoProcessWhileAJobIsWaitedFor) {
  pthread_atfork([] { ++forks; }, nullptr, nullptr);
  gather_facts("/proc/self/exe", 1, launch::Ask::no_programs);
  EXPECT_EQ(forks, 0);
  gather_facts("/proc/self/exe", 1, launch::Ask::programs);
  EXPECT_GT(forks, 0) << "or the test sees none";
}

}  // namespace
}  // namespace mars::doctor
