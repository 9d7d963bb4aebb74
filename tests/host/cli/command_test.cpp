// Mistakes of a command line are explained in MARS's own words.
#include "host/cli/command.h"

#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "host/cli/program.h"

namespace mars::cli {
namespace {

std::string refusal(std::vector<const char*> words) {
  std::optional<std::uint16_t> port;
  std::uint32_t count = 0;
  double delay = 0;
  std::vector<double> place;
  std::string way;
  std::vector<std::tuple<std::string, double, double>> limits;
  Program program("test", "a test");
  program.add("--port", port, "A port. Example: --port 80").type("N");
  program.add("--count", count, "A count. Example: --count 3").type("N").range(std::uint32_t{2}, std::uint32_t{9});
  program.add("--delay", delay, "Seconds. Example: --delay 0.5").type("SECONDS").range(-1.5, 1e6);
  program.add("--place", place, "A place. Example: --place 1 2 3").words(3).type("X Y Z");
  program.add("--way", way, "A way. Example: --way up").type("WAY").one_of({"up", "down"});
  program.add("--limit", limits, "A limit. Example: --limit x 1 2").repeated().type("AXIS LEAST MOST");
  words.insert(words.begin(), "test");
  testing::internal::CaptureStderr();
  program.read(static_cast<int>(words.size()), words.data());
  return testing::internal::GetCapturedStderr();
}

TEST(CommandWords, ThatAreNoNumbersAreExplained) {
  const std::pair<std::vector<const char*>, const char*> wrong[] = {
      {{"--port", "abc"}, "--port: 'abc' is no whole number"},
      {{"--port", "3.5"}, "--port: '3.5' is no whole number"},
      {{"--port", "70000"}, "--port: '70000' is not from 0 to 65535"},
      {{"--port", "99999999999"}, "--port: '99999999999' is not from 0 to 65535"},
      {{"--count", "x"}, "--count: 'x' is no whole number"},
      {{"--count", "1"}, "--count: '1' is no number from 2 to 9"},
      {{"--delay", "x"}, "--delay: 'x' is no number"},
      {{"--delay", "-2"}, "--delay: '-2' is no number from -1.5 to 1000000"},
      {{"--place", "1", "x", "3"}, "--place: 'x' is no number"},
      {{"--place", "1", "2"}, "--place: write X Y Z, as in --place 1 2 3"},
      {{"--way", "left"}, "--way: 'left' is none of up, down"},
      {{"--limit", "x", "1", "y"}, "--limit: write AXIS LEAST MOST, as in --limit x 1 2"},
      {{"--count"}, "--count: N is missing"},
  };
  for (const auto& [words, says] : wrong) {
    const std::string text = refusal(words);
    EXPECT_NE(text.find(says), std::string::npos) << text;
    for (const char* foreign : {"Could not convert", "not in range", "required", "not in {"})
      EXPECT_EQ(text.find(foreign), std::string::npos) << text;
  }
}

TEST(CommandWords, ThatAreSoundAreTaken) {
  EXPECT_EQ(refusal({"--port", "65535", "--count", "9", "--delay", "-1.5", "--place", "1", "-2", "3e2", "--way", "down",
                     "--limit", "x", "-1", "2"}),
            "");
}

}  // namespace
}  // namespace mars::cli
