#include <stdlib.h>

#include <cstdlib>
#include <string>

#include <gtest/gtest.h>

#include "hal/failure/failure.h"
#include "hal/messages/settings.h"

namespace mars::messages {
namespace {

// One variable of this process's environment, for a while.
class Variable {
 public:
  Variable(const std::string& name, const std::string& value) : name_(name) { setenv(name.c_str(), value.c_str(), 1); }
  ~Variable() { unsetenv(name_.c_str()); }

 private:
  std::string name_;
};

class SettingsTest : public testing::Test {
 protected:
  void SetUp() override {
    for (const Setting& each : settings_table()) unsetenv(each.name);
  }
};

TEST_F(SettingsTest, HaveDefaults) {
  EXPECT_FALSE(read_settings().memory);
  EXPECT_EQ(read_settings().simd, "");
}

TEST_F(SettingsTest, AreRead) {
  const Variable memory("MARS_MEMORY", "64");
  EXPECT_EQ(read_settings().memory, 64u * 1024 * 1024);
  for (const std::string name : {"sse2", "sse4", "avx2", "avx512"}) {
    const Variable simd("MARS_SIMD", name);
    EXPECT_EQ(read_settings().simd, name);
  }
}

TEST_F(SettingsTest, ThatAreMalformedNameVariableAndRemedy) {
  for (const std::string value :
       {"", "x", "-1", "0", "1.5", "12MB", " 1", "99999999999999999999", "18446744073709551615"}) {
    const Variable memory("MARS_MEMORY", value);
    try {
      read_settings();
      FAIL() << value;
    } catch (const Failure& failure) {
      EXPECT_NE(failure.where.find("MARS_MEMORY"), std::string::npos);
      EXPECT_NE(failure.remedy.find("unset"), std::string::npos);
    }
  }
  for (const std::string value : {"", "AVX2", "neon"}) {
    const Variable simd("MARS_SIMD", value);
    EXPECT_THROW(read_settings(), Failure);
  }
}

TEST_F(SettingsTest, OfMessagesAreRead) {
  EXPECT_FALSE(read_settings().nx_strict);
  EXPECT_FALSE(read_settings().nx_handler_thread);
  {
    const Variable strict("MARS_NX_STRICT", "yes");
    const Variable handlers("MARS_NX_HANDLERS", "thread");
    EXPECT_TRUE(read_settings().nx_strict);
    EXPECT_TRUE(read_settings().nx_handler_thread);
  }
  for (const std::string value : {"", "1", "Yes"}) {
    const Variable strict("MARS_NX_STRICT", value);
    EXPECT_THROW(read_settings(), Failure);
  }
  const Variable handlers("MARS_NX_HANDLERS", "threads");
  EXPECT_THROW(read_settings(), Failure);
}

TEST_F(SettingsTest, ThatAreUnknownAreReportedWithTheNearestName) {
  const Variable known("MARS_SIMD", "avx2");
  const Variable memory("MARS_MEMROY", "1");
  const Variable simd("MARS_SIM", "x");
  const Variable foreign("MARSH", "1");
  std::string lines;
  for (const std::string& line : unknown_settings()) lines += line + "\n";
  EXPECT_NE(lines.find("MARS_MEMROY means nothing to MARS (did you mean MARS_MEMORY?)"), std::string::npos) << lines;
  EXPECT_NE(lines.find("MARS_SIM means nothing to MARS (did you mean MARS_SIMD?)"), std::string::npos) << lines;
  EXPECT_EQ(lines.find("variable MARS_SIMD "), std::string::npos) << lines;
  EXPECT_EQ(lines.find("MARSH"), std::string::npos) << lines;
}

TEST_F(SettingsTest, TextNamesEach) {
  for (const Setting& each : settings_table()) {
    EXPECT_NE(settings_text(each.of_nx()).find(each.name), std::string::npos);
    EXPECT_NE(settings_text(each.of_nx()).find(each.meaning), std::string::npos);
    EXPECT_EQ(settings_text(!each.of_nx()).find(each.name), std::string::npos);
  }
}

}  // namespace
}  // namespace mars::messages
