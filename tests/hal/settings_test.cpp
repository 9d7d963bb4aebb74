#include <cstdlib>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "hal/failure.h"
#include "hal/settings.h"

namespace mars::hal {
namespace {

using Lines = std::vector<std::string>;

TEST(Settings, HaveDefaults) {
  const Settings settings = read_settings(Lines{"PATH=/bin", "MARS_MEMORYX=3"});
  EXPECT_FALSE(settings.memory);
  EXPECT_EQ(settings.simd, SimdLimit::avx512);
}

TEST(Settings, AreRead) {
  const Settings settings = read_settings(Lines{"MARS_SIMD=avx2", "MARS_MEMORY=64"});
  EXPECT_EQ(settings.memory, 64u * 1024 * 1024);
  EXPECT_EQ(settings.simd, SimdLimit::avx2);
  EXPECT_EQ(read_settings(Lines{"MARS_SIMD=sse2"}).simd, SimdLimit::sse2);
}

TEST(Settings, OfThisProcess) {
  setenv("MARS_MEMORY", "17", 1);
  EXPECT_EQ(read_settings(environment()).memory, 17u * 1024 * 1024);
  unsetenv("MARS_MEMORY");
  EXPECT_FALSE(read_settings(environment()).memory);
}

TEST(Settings, ThatAreMalformedNameVariableAndRemedy) {
  for (const std::string value :
       {"", "x", "-1", "0", "1.5", "12MB", " 1", "99999999999999999999", "18446744073709551615"}) {
    try {
      read_settings(Lines{"MARS_MEMORY=" + value});
      FAIL() << value;
    } catch (const Failure& failure) {
      EXPECT_NE(failure.where.find("MARS_MEMORY"), std::string::npos);
      EXPECT_NE(failure.remedy.find("unset"), std::string::npos);
    }
  }
  EXPECT_THROW(read_settings(Lines{"MARS_SIMD=AVX2"}), Failure);
  EXPECT_THROW(read_settings(Lines{"MARS_SIMD="}), Failure);
}

TEST(Settings, ThatAreUnknownAreToldWithTheNearestName) {
  const Lines told =
      unknown_settings(Lines{"MARS_MEMROY=1", "MARS_SIMD=avx2", "HOME=/", "MARS_SIM=x", "MARSH=1"});
  ASSERT_EQ(told.size(), 2u);
  EXPECT_NE(told[0].find("MARS_MEMROY"), std::string::npos);
  EXPECT_NE(told[0].find("mean MARS_MEMORY?"), std::string::npos);
  EXPECT_NE(told[1].find("mean MARS_SIMD?"), std::string::npos);
}

TEST(Settings, TextNamesEach) {
  for (const Setting& each : settings_table()) {
    EXPECT_NE(settings_text().find(each.name), std::string::npos);
    EXPECT_NE(settings_text().find(each.meaning), std::string::npos);
  }
}

}  // namespace
}  // namespace mars::hal
