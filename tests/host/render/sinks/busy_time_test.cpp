#include "host/render/sinks/busy_time.h"

#include <gtest/gtest.h>

namespace mars::sinks {
namespace {

TEST(BusyTime, CountsTimesTogetherOnce) {
  BusyTime busy;
  EXPECT_EQ(busy.seconds(), 0);
  busy.add(2, 3);
  busy.add(5, 6);
  EXPECT_EQ(busy.seconds(), 2);
  busy.add(5.5, 7);
  EXPECT_EQ(busy.seconds(), 3);
  busy.add(0, 8);
  EXPECT_EQ(busy.seconds(), 8);
  busy.add(9, 9);
  EXPECT_EQ(busy.seconds(), 8);
}

}  // namespace
}  // namespace mars::sinks
