#include <functional>
#include <vector>

#include "hal/messages/recorder.h"

#include <gtest/gtest.h>

#include "hal/messages/process.h"
#include "hal/nx/nx_messages.h"
#include "hal/threads/run_threads.h"

namespace mars::messages {
namespace {

using Kind = Event::Kind;

constexpr int kType = 5, kSilent = 9;

// The host sends node 0 three messages, the second of a silent type, and hears from it at the end.
void host_body() {
  for (const int type : {kType, kSilent, kType}) csend(type, "abcd", 4, 0, 0);
  crecv(kType, nullptr, 0);
}

void receive_all() {
  char text[4];
  for (const int type : {kType, kSilent, kType}) crecv(type, text, sizeof text);
}

void run(const std::function<void()>& node) {
  threads::run_threads(1, host_body, [&] {
    node();
    csend(kType, nullptr, 0, myhost(), 0);
  });
}

TEST(Recorder, SeesMessagesButTheSilent) {
  run([] {
    Recorder recorder(100, kSilent);
    receive_all();
    std::vector<std::uint32_t> numbers;
    const auto events = recorder.turn(false);
    for (const Event& event : events) {
      EXPECT_LE(event.begin, event.end);
      if (event.kind != Kind::taken) continue;
      numbers.push_back(event.number);
      EXPECT_EQ(event.what, kType);
      EXPECT_EQ(event.peer, myhost());
      EXPECT_EQ(event.value, 4u);
    }
    EXPECT_EQ(numbers, (std::vector<std::uint32_t>{0, 2})) << "the silent one is counted";
    EXPECT_EQ(events.back().kind, Kind::lost);
    EXPECT_EQ(events.back().value, 0u);
  });
}

TEST(Recorder, NumbersGoOnWhereNobodyRecords) {
  run([] {
    receive_all();
    Recorder recorder(100, kSilent);
    csend(kSilent, nullptr, 0, 0, 0);
    csend(kType, nullptr, 0, 0, 0);
    const auto events = recorder.turn(false);
    ASSERT_EQ(events.size(), 2u);
    EXPECT_EQ(events[0].kind, Kind::sent);
    EXPECT_EQ(events[0].number, 1u);
    crecv(kSilent, nullptr, 0);
    crecv(kType, nullptr, 0);
  });
}

TEST(Recorder, CountsWhatDoesNotFit) {
  run([] {
    Recorder recorder(3, kSilent);
    record_frame(12);
    for (int i = 0; i < 5; ++i) record_span(i, 1, 2, 7);
    const auto first = recorder.turn(false);
    ASSERT_EQ(first.size(), 4u);
    EXPECT_EQ(first[2].what, 2);
    EXPECT_EQ(first[2].frame, 12);
    EXPECT_EQ(first[2].value, 7u);
    EXPECT_EQ(first[3].value, 2u);
    record_span(8, 2, 3);
    const auto last = recorder.turn(true);
    ASSERT_EQ(last.size(), 2u);
    EXPECT_EQ(last[0].what, 8);
    EXPECT_EQ(last[1].number, 1u);
    EXPECT_EQ(first[2].what, 2) << "the other half is left alone";
    receive_all();
  });
}

TEST(Recorder, NothingIsRecordedWithoutOne) {
  run([] {
    { Recorder recorder(3, kSilent); }
    record_span(1, 1, 2);
    EXPECT_EQ(process().recorder(), nullptr);
    receive_all();
  });
}

}  // namespace
}  // namespace mars::messages
