#include "host/shell/doctor/answers.h"

#include <gtest/gtest.h>

#include "tests/host/content/document/failure_of.h"

namespace mars::doctor {
namespace {

using State = Finding::State;

const SystemTime kNow{std::chrono::hours(500000)};
const std::string kDropped = "packets are dropped, by a firewall?";

Peer peer(const std::string& host) { return {host, 4711, {"10.77.0.11", "10.78.0.11"}}; }

// Lines as they come over ssh.
void take(Answers& answers, std::string line, SystemTime now = kNow) {
  line.pop_back();
  EXPECT_TRUE(answers.take(line, now)) << line;
}

// Machines that have all answered, none of which missed another.
Answers answers_of(const std::vector<std::string>& hosts) {
  Answers answers;
  for (const std::string& each : hosts) take(answers, door_line(peer(each)));
  answers.given = kNow;
  for (const std::string& each : hosts) {
    take(answers, clock_line(each, kNow));
    take(answers, met_line(each));
  }
  return answers;
}

Finding about(const std::string& topic, const Answers& answers) {
  for (const Finding& each : check_together(answers))
    if (each.about == topic) return each;
  return {};
}

TEST(Answers, TravelWhole) {
  Answers answers;
  EXPECT_FALSE(answers.has_door("n1"));
  take(answers, door_line(peer("n1")));
  take(answers, lines_of({"n1", {{State::note, "user", "root", ""}}}));
  take(answers, missed_line({"n1", "n3", kDropped}));
  EXPECT_TRUE(answers.has_door("n1"));
  EXPECT_FALSE(answers.met.contains("n1"));
  take(answers, met_line("n1"));
  EXPECT_TRUE(answers.met.contains("n1"));
  EXPECT_EQ(answers.missed, (std::vector<Missed>{{"n1", "n3", kDropped}}));
  EXPECT_EQ(answers.findings[0].findings[0].found, "root");
  const std::vector<Peer> peers{peer("n1"), peer("n2")};
  EXPECT_EQ(read_doors(doors_line(peers)), peers);
}

TEST(Answers, WhatIsNoneIsRefused) {
  Answers answers;
  for (const char* line :
       {"", "Welcome to n3!", "{", "[1]", "7", "{}", R"({"host": 7})", R"({"host": "n1"})",
        R"({"host": "n1", "about": 1})", "@met n1", "@clock n1 7", "@missed n1 n2 why", "@", "@clock"})
    EXPECT_FALSE(answers.take(line, kNow)) << line;
  for (const char* line : {"@door", "@door n1 x 10.0.0.1", "@door n1 70000 10.0.0.1"}) answers.take(line, kNow);
  EXPECT_TRUE(answers.doors.empty());
  EXPECT_TRUE(check_together(answers).empty());
}

TEST(Together, AllIsWell) {
  const Answers answers = answers_of({"n1", "n2", "n3"});
  for (const Finding& each : check_together(answers)) EXPECT_EQ(each.state, State::good) << each.found;
  EXPECT_EQ(about("machines", answers).found, "3 machines answered: n1-n3");
  EXPECT_EQ(about("ports", answers).found, "all machines reach each other by TCP");
}

TEST(Together, AFirewallNamesTheMachineBehindIt) {
  Answers answers = answers_of({"n1", "n2", "n3", "n4"});
  for (const char* other : {"n1", "n2", "n4"}) {
    take(answers, missed_line({other, "n3", kDropped}));
    take(answers, missed_line({"n3", other, kDropped}));
  }
  const Finding found = about("ports", answers);
  EXPECT_EQ(found.state, State::trouble);
  EXPECT_EQ(found.found,
            "n1,n2,n4 cannot reach n3 by TCP: " + kDropped + "\nn3 cannot reach n1,n2,n4 by TCP: " + kDropped);
  EXPECT_TRUE(document::holds(found.remedy, "open the ports"));
}

TEST(Together, DifferentWaysOfNotReachingAreDifferentLines) {
  EXPECT_EQ(who_cannot_reach(std::vector<Missed>{{"n1", "n2", kDropped}, {"n1", "n3", "No route to host"}}),
            (std::vector<std::string>{"n1 cannot reach n3 by TCP: No route to host",
                                      "n1 cannot reach n2 by TCP: " + kDropped}));
}

// A clock may be read at any time between the question and the answer.
TEST(Together, ClocksDifferByMoreThanTheWayTakes) {
  using std::chrono::seconds;
  const auto with_clock = [](double ahead, seconds way) {
    Answers answers = answers_of({"n1", "n2"});
    const auto other = std::chrono::duration_cast<SystemTime::duration>(std::chrono::duration<double>(ahead));
    take(answers, clock_line("n2", kNow + other), kNow + way);
    return about("clocks", answers);
  };
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
