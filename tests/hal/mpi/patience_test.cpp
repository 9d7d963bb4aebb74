#include "hal/mpi/patience.h"

#include <gtest/gtest.h>

namespace mars::mpi {
namespace {

using namespace std::chrono_literals;

TEST(Patience, LooksAtOnceThenYieldsThenSleepsLongerAndLonger) {
  for (const bool oversubscribed : {false, true}) {
    const int at_once = turns_at_once(oversubscribed);
    EXPECT_EQ(pause_of(at_once - 1, oversubscribed, false), std::nullopt);
    EXPECT_EQ(pause_of(at_once, oversubscribed, false), 0us);
    EXPECT_GT(*pause_of(10000, oversubscribed, false), 5ms);
  }
}

// A look and a yield take long then, where there are more ranks than slots.
TEST(Patience, SleepsAtOnceInACrowd) {
  EXPECT_GT(*pause_of(0, true, true), 100us);
  EXPECT_LT(*pause_of(0, true, true), 1ms);
  EXPECT_EQ(pause_of(0, false, true), std::nullopt) << "looks are quick";
  EXPECT_EQ(pause_of(turns_at_once(false), false, true), pause_of(0, true, true));
}

TEST(Crowd, IsTakenForGrantedForAsLongAsItTakesMuch) {
  Crowd crowd;
  crowd.note(100, 100.001);
  EXPECT_EQ(crowd.until(), 0) << "a yield to a rank that had little to do";
  crowd.note(100, 100.2);
  EXPECT_GT(crowd.until(), 102);
  EXPECT_LT(crowd.until(), 110);
}

}  // namespace
}  // namespace mars::mpi
