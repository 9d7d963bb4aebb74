#include "host/shell/doctor/answers.h"

#include <gtest/gtest.h>

#include "tests/host/content/document/failure_of.h"

namespace mars::doctor {
namespace {

using State = Finding::State;

constexpr std::uint64_t kGibibyte = std::uint64_t{1} << 30;
const SystemTime kNow{std::chrono::hours(500000)};
const std::string kDropped = "packets are dropped, by a firewall?";

Presence presence(const std::string& host, std::uint64_t memory = 8 * kGibibyte) {
  return {{host, {"10.77.0.11", "10.78.0.11"}, 4711}, "MARS 1.2.3, mars-node 12345678", memory, true};
}

// Machines that have all answered, none of which missed another.
Answers answers_of(const std::vector<Presence>& all) {
  Answers answers;
  for (const Presence& each : all) EXPECT_TRUE(answers.take(line_of(each), kNow));
  answers.doors_are_sent(kNow);
  for (const Presence& each : all) {
    EXPECT_TRUE(answers.take(clock_line(each.peer.host, kNow), kNow));
    EXPECT_TRUE(answers.take(line_of(each.peer.host, std::vector<Missed>()), kNow));
  }
  return answers;
}

Finding about(const std::string& topic, const Answers& answers) {
  for (const Finding& each : check_together(answers, "/work/frames"))
    if (each.about == topic) return each;
  return {};
}

void misses(Answers& answers, const std::string& from, const std::vector<Missed>& missed) {
  EXPECT_TRUE(answers.take(line_of(from, missed), kNow));
}

TEST(Answers, TravelWhole) {
  Answers answers;
  EXPECT_FALSE(answers.is_present("n1"));
  EXPECT_TRUE(answers.take(line_of(presence("n1")), kNow));
  EXPECT_TRUE(answers.take(lines_of({"n1", {{State::note, "user", "root", ""}}}), kNow));
  EXPECT_TRUE(answers.is_present("n1"));
  EXPECT_FALSE(answers.has_met("n1"));
  misses(answers, "n1", {{"n3", kDropped}});
  EXPECT_TRUE(answers.has_met("n1"));
  EXPECT_EQ(answers.machines()[0].presence.build, presence("n1").build);
  EXPECT_EQ(answers.machines()[0].missed->front(), (Missed{"n3", kDropped}));
  EXPECT_EQ(answers.findings()[0].findings[0].found, "root");
  EXPECT_EQ(read_peers(line_of(answers.peers())), std::vector{presence("n1").peer});
}

TEST(Answers, WhatIsNoneIsRefused) {
  Answers answers;
  for (const char* line : {"", "Welcome to n3!", "{", "[1]", "7", "{}", R"({"host": 7})", R"({"host": "n1"})",
                           R"({"host": "n1", "port": "x", "addresses": 1})", R"({"host": "n1", "missed": []})",
                           R"({"host": "n1", "about": 1})", R"({"host": "n1", "port": 1, "addresses": ["a"]})"})
    EXPECT_FALSE(answers.take(line, kNow)) << line;
  EXPECT_TRUE(answers.machines().empty());
  for (const char* line : {"", "7", "[7]", R"([{"host": "n1"}])"}) EXPECT_FALSE(read_peers(line)) << line;
}

TEST(Together, AllIsWell) {
  const Answers answers = answers_of({presence("n1"), presence("n2", 2 * kGibibyte), presence("n3", 0)});
  for (const Finding& each : check_together(answers, "/work/frames")) EXPECT_EQ(each.state, State::good) << each.found;
  EXPECT_EQ(about("machines", answers).found, "3 machines answered: n1-n3; least memory: 2.0 GiB on n2");
  EXPECT_EQ(about("ports", answers).found, "all machines reach each other by TCP");
  EXPECT_EQ(about("versions", answers).found, "the same MARS on all machines: MARS 1.2.3, mars-node 12345678");
  EXPECT_EQ(about("folder", answers).found, "all machines see /work/frames");
}

TEST(Together, AFirewallNamesTheMachineBehindIt) {
  Answers answers = answers_of({presence("n1"), presence("n2"), presence("n3"), presence("n4")});
  for (const char* other : {"n1", "n2", "n4"}) misses(answers, other, {{"n3", kDropped}});
  misses(answers, "n3", {{"n1", kDropped}, {"n2", kDropped}, {"n4", kDropped}});
  const Finding found = about("ports", answers);
  EXPECT_EQ(found.state, State::trouble);
  EXPECT_EQ(found.found,
            "n1,n2,n4 cannot reach n3 by TCP: " + kDropped + "\nn3 cannot reach n1,n2,n4 by TCP: " + kDropped);
  EXPECT_TRUE(document::holds(found.remedy, "open the ports"));
}

TEST(Together, DifferentWaysOfNotReachingAreDifferentLines) {
  Answers answers = answers_of({presence("n1"), presence("n2"), presence("n3")});
  misses(answers, "n1", {{"n2", kDropped}, {"n3", "No route to host"}});
  EXPECT_EQ(who_cannot_reach(answers.machines()),
            (std::vector<std::string>{"n1 cannot reach n3 by TCP: No route to host",
                                      "n1 cannot reach n2 by TCP: " + kDropped}));
}

TEST(Together, OtherVersions) {
  Presence other = presence("n2");
  other.build = "MARS 1.2.4, mars-node 87654321";
  const Finding found = about("versions", answers_of({presence("n1"), other, presence("n3")}));
  EXPECT_EQ(found.state, State::trouble);
  EXPECT_EQ(found.found, "n1,n3: MARS 1.2.3, mars-node 12345678; n2: MARS 1.2.4, mars-node 87654321");
}

TEST(Together, OtherMpis) {
  Answers answers = answers_of({presence("n1"), presence("n2")});
  for (const auto& [host, mpi] : {std::pair{"n1", "Open MPI 4.1.4"}, std::pair{"n2", "Open MPI 5.0.3"}})
    EXPECT_TRUE(answers.take(lines_of({host, {{State::good, "MPI", mpi, ""}}}), kNow));
  const auto findings = check_together(answers, "");
  EXPECT_EQ(findings.back().found, "the machines have different MPIs: see MPI below");
}

TEST(Together, AFolderThatOneDoesNotSee) {
  Presence blind = presence("n2");
  blind.sees_folder = false;
  const Finding found = about("folder", answers_of({presence("n1"), blind}));
  EXPECT_EQ(found.state, State::note);
  EXPECT_EQ(found.found, "n2: cannot see /work/frames of this machine");
}

// A clock may be read at any time between the question and the answer.
TEST(Together, ClocksDifferByMoreThanTheWayTakes) {
  const auto with_clock = [](double seconds, std::chrono::seconds way) {
    Answers answers = answers_of({presence("n1"), presence("n2")});
    const auto ahead = std::chrono::duration_cast<SystemTime::duration>(std::chrono::duration<double>(seconds));
    EXPECT_TRUE(answers.take(clock_line("n2", kNow + ahead), kNow + way));
    return about("clocks", answers);
  };
  using std::chrono::seconds;
  EXPECT_EQ(with_clock(1.5, seconds(0)).state, State::good);
  EXPECT_EQ(with_clock(5, seconds(4)).state, State::good);
  EXPECT_EQ(with_clock(-1.5, seconds(4)).state, State::good);
  EXPECT_EQ(with_clock(7, seconds(4)).found, "differ from this machine's: n2's by +3.0 s");
  EXPECT_EQ(with_clock(-7, seconds(4)).found, "differ from this machine's: n2's by -7.0 s");
}

TEST(Silence, NamesMachineAndReason) {
  const auto found = [](const std::string& words) { return check_silence({"n3"}, words, "/opt/mars/mars").found; };
  EXPECT_EQ(found("ssh: Could not resolve hostname n3: Name or service not known\n"), "n3: the name does not resolve");
  EXPECT_EQ(found("root@n3: Permission denied (publickey,password).\n"), "n3: ssh is refused");
  EXPECT_EQ(found("ssh: connect to host n3 port 22: Connection timed out\n"), "n3: ssh gets no answer");
  EXPECT_EQ(found("ssh: connect to host n3 port 22: Connection refused\n"), "n3: ssh is refused: no sshd listens");
  EXPECT_EQ(found("Host key verification failed.\n"), "n3: ssh does not know the machine's key");
  EXPECT_EQ(found("env: '/opt/mars/mars': No such file or directory\n"), "n3: cannot run /opt/mars/mars");
  EXPECT_EQ(found("env: '/opt/mars/mars': Permission denied\n"), "n3: cannot run /opt/mars/mars");
  EXPECT_EQ(found("/opt/mars/mars: error while loading shared libraries: libpng16.so.16: cannot open shared object "
                  "file: No such file or directory\n"),
            "n3: lacks the library libpng16.so.16");
  EXPECT_EQ(found(""), "n3: has not answered");
  EXPECT_EQ(found("what nobody\nhas seen\n"), "n3: did not answer; the last words: what nobody has seen");
  EXPECT_EQ(check_silence({"n2", "n3", "n4"}, "", "mars").found, "n2-n4: has not answered");
}

}  // namespace
}  // namespace mars::doctor
