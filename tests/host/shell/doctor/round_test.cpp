// Machines are shells that speak as MARS does, or do not.
#include "host/shell/doctor/round.h"

#include <gtest/gtest.h>

namespace mars::doctor {
namespace {

constexpr RoundLimits kPatient{std::chrono::minutes(5), std::chrono::minutes(5)};

Call call(const std::string& host, const std::string& script) { return {{host}, {{}, {"/bin/sh", "-c", script}}}; }

std::string echo(std::string line) {
  line.pop_back();
  return "echo '" + line + "'; ";
}

std::string door(const std::string& host) { return echo(door_line({host, 1, {"127.0.0.1"}})); }

// Answers, is given all doors, and says `more`.
std::string sound(const std::string& host, const std::string& more = "") {
  return door(host) + "read doors; " + more + echo(met_line(host)) + "cat";
}

TEST(Round, HearsAllMachines) {
  const std::string misses = sound("n2", echo(missed_line({"n2", "n1", "no"})));
  const Round round = go_round({call("n1", sound("n1")), call("n2", "echo Welcome; " + misses)}, "mars", kPatient);
  EXPECT_TRUE(round.silences.empty());
  EXPECT_EQ(who_cannot_reach(round.answers.missed), std::vector<std::string>{"n2 cannot reach n1 by TCP: no"});
}

TEST(Round, SeveralMachinesMayHaveOneVoice) {
  const Call both{{"n1", "n2"}, {{}, {"/bin/sh", "-c", door("n1") + sound("n2", echo(met_line("n1")))}}};
  EXPECT_TRUE(go_round({both}, "mars", kPatient).silences.empty());
}

TEST(Round, AllAreGivenTheDoorsOfThoseThatAnswered) {
  const std::string script = door("n1") + "read doors; echo \"got $doors\"";
  const Round round = go_round({call("n1", script), call("n2", "exit 1")}, "mars", kPatient);
  ASSERT_EQ(round.silences.size(), 2u);
  EXPECT_EQ(round.silences[0].found,
            "n1: answered, but did not say which others can be reached from there; the last "
            "words: got n1 1 127.0.0.1");
}

TEST(Round, SilentMachinesAreNamedWithTheirReasons) {
  const Round round =
      go_round({call("n1", sound("n1")), call("n2", "echo 'ssh: Could not resolve hostname n2' >&2; exit 255"),
                call("n3", "exit 0"), call("n4", "printf '%100000s' x")},
               "mars", kPatient);
  ASSERT_EQ(round.silences.size(), 3u);
  EXPECT_EQ(round.silences[0].found, "n2: the name does not resolve");
  EXPECT_EQ(round.silences[1].found, "n3: has not answered");
  EXPECT_EQ(round.silences[2].found, "n4: did not answer; the last words: x");
}

TEST(Round, DoesNotWaitLongerThanTheLimit) {
  const Round round = go_round({call("n1", "exec cat >/dev/null"), call("n2", sound("n2"))}, "mars",
                               {std::chrono::milliseconds(200), std::chrono::minutes(5)});
  ASSERT_EQ(round.silences.size(), 2u - round.answers.met.count("n2"));
  EXPECT_EQ(round.silences[0].found, "n1: has not answered");
}

}  // namespace
}  // namespace mars::doctor
