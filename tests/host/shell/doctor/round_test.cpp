// Machines are shells that speak as MARS does, or do not.
#include "host/shell/doctor/round.h"

#include <gtest/gtest.h>

#include "tests/host/content/document/failure_of.h"

namespace mars::doctor {
namespace {

constexpr RoundLimits kPatient{std::chrono::minutes(5), std::chrono::minutes(5)};

Call call(const std::string& host, const std::string& script) { return {{host}, {{}, {"/bin/sh", "-c", script}}}; }

// Answers, is given everybody's door, and says that it misses `missed`.
std::string sound(const std::string& host, const std::vector<Missed>& missed = {}) {
  std::string presence = line_of(Presence{{host, {"127.0.0.1"}, 1}, "MARS", 1, true});
  std::string meeting = line_of(host, missed);
  presence.pop_back();
  meeting.pop_back();
  return "echo '" + presence + "'; read doors; echo '" + meeting + "'; cat";
}

TEST(Round, HearsAllMachines) {
  const Round round =
      go_round({call("n1", sound("n1")), call("n2", "echo Welcome; " + sound("n2", {{"n1", "no"}}))}, "mars", kPatient);
  EXPECT_TRUE(round.silences.empty());
  EXPECT_EQ(who_cannot_reach(round.answers.machines()), std::vector<std::string>{"n2 cannot reach n1 by TCP: no"});
}

TEST(Round, AllAreGivenTheDoorsOfThoseThatAnswered) {
  const std::string script =
      "echo '" + line_of(Presence{{"n1", {"127.0.0.1"}, 1}, "MARS", 1, true}) + "'; read doors; echo \"got $doors\"";
  const Round round = go_round({call("n1", script), call("n2", sound("n2")), call("n3", "exit 1")}, "mars", kPatient);
  ASSERT_EQ(round.silences.size(), 2u);
  const std::string& last_words = round.silences[0].found;
  for (const char* host : {R"("host":"n1")", R"("host":"n2")"}) EXPECT_TRUE(document::holds(last_words, host));
  EXPECT_FALSE(document::holds(last_words, "n3")) << last_words;
}

TEST(Round, SilentMachinesAreNamedWithTheirReasons) {
  const Round round =
      go_round({call("n1", sound("n1")), call("n2", "echo 'ssh: Could not resolve hostname n2' >&2; exit 255"),
                call("n3", "exit 0"), call("n4", "printf '%100000s' x")},
               "mars", kPatient);
  ASSERT_EQ(round.silences.size(), 3u);
  EXPECT_EQ(round.silences[0].found, "n2: the name does not resolve");
  EXPECT_EQ(round.silences[1].found, "n3: has not answered");
  EXPECT_TRUE(round.silences[2].found.starts_with("n4: did not answer; the last words: x"));
}

TEST(Round, DoesNotWaitLongerThanTheLimit) {
  const Round round = go_round({call("n1", "exec cat >/dev/null"), call("n2", sound("n2"))}, "mars",
                               {std::chrono::milliseconds(200), std::chrono::minutes(5)});
  ASSERT_EQ(round.silences.size(), 2u - round.answers.has_met("n2"));
  EXPECT_EQ(round.silences[0].found, "n1: has not answered");
}

}  // namespace
}  // namespace mars::doctor
