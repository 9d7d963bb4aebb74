#include "tests/hal/nx_bodies.h"

#include <sys/resource.h>

#include <algorithm>
#include <bit>
#include <chrono>
#include <cstdint>
#include <functional>
#include <numeric>
#include <string>
#include <thread>

#include <gtest/gtest.h>

#include "hal/cube.h"
#include "hal/failure.h"
#include "hal/nx/nx_global.h"
#include "hal/nx/nx_messages.h"
#include "hal/process.h"
#include "hal/shared_memory.h"

namespace mars::hal {
namespace {

bool is_host() { return mynode() == myhost(); }

// What the failure says that `call` ends with.
std::string failure_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const Failure& failure) {
    return failure.what();
  }
  return "no failure";
}

void expect_in(const std::string& text, const std::vector<std::string>& parts) {
  for (const std::string& part : parts) EXPECT_NE(text.find(part), std::string::npos) << text;
}

std::vector<std::uint32_t> pattern(std::size_t words, std::uint32_t seed) {
  std::vector<std::uint32_t> data(words);
  for (std::uint32_t& word : data) word = seed = seed * 1664525u + 1013904223u;
  return data;
}

template <class T>
long bytes_of(const std::vector<T>& data) {
  return static_cast<long>(data.size() * sizeof(T));
}

void send_long(long type, long value, long to) { csend(type, &value, sizeof value, to, 0); }

long receive_long(long typesel) {
  long value = -1;
  crecv(typesel, &value, sizeof value);
  return value;
}

void ranks_know_themselves() {
  EXPECT_EQ(myhost(), numnodes());
  EXPECT_GE(1L << nodedim(), numnodes());
  if (numnodes() > 1) {
    EXPECT_LT(1L << (nodedim() - 1), numnodes());
  }
  if (is_host()) return;
  const long one = 1;
  long nodes = one;
  long work = 0;
  gisum(&nodes, 1, &work);
  EXPECT_EQ(nodes, numnodes());
}

void messages_go_round_a_ring() {
  if (is_host()) return;
  const long next = (mynode() + 1) % numnodes();
  const long before = (mynode() + numnodes() - 1) % numnodes();
  send_long(7, 100 + mynode(), next);
  EXPECT_EQ(receive_long(7), 100 + before);
  EXPECT_EQ(infonode(), before);
  EXPECT_EQ(infotype(), 7);
  EXPECT_EQ(infocount(), static_cast<long>(sizeof(long)));
  EXPECT_EQ(infopid(), 0);
}

void host_talks_with_every_node() {
  if (!is_host()) {
    send_long(20 + mynode(), receive_long(10 + mynode()) * 2, myhost());
    return;
  }
  for (long node = 0; node < numnodes(); ++node) send_long(10 + node, 1000 + node, node);
  for (long node = 0; node < numnodes(); ++node) EXPECT_EQ(receive_long(20 + node), 2000 + 2 * node);
}

void minus_one_is_all_other_nodes() {
  if (mynode() == 0) send_long(30, 5, -1);
  if (!is_host() && mynode() != 0) {
    EXPECT_EQ(receive_long(30), 5);
  }
  if (is_host()) send_long(31, 6, -1);
  if (!is_host()) {
    EXPECT_EQ(receive_long(31), 6);
  }
  if (mynode() == 0) {
    long seven = 7;
    msgwait(isend(32, &seven, sizeof seven, -1, 0));
  }
  if (!is_host() && mynode() != 0) {
    EXPECT_EQ(receive_long(32), 7);
  }
  if (is_host()) return;
  gsync();
  EXPECT_EQ(iprobe(-1), 0);
}

void a_rank_sends_to_itself() {
  send_long(8, 80 + mynode(), mynode());
  EXPECT_EQ(receive_long(8), 80 + mynode());
  EXPECT_EQ(infonode(), mynode());
}

void ten_thousand_messages_stay_in_order() {
  constexpr long kMessages = 10000;
  const long sender = numnodes() - 1;
  if (mynode() == sender) {
    for (long i = 0; i < kMessages; ++i) send_long(i % 3, i, myhost());
  }
  if (!is_host()) return;
  for (long i = 0; i < kMessages; ++i) {
    ASSERT_EQ(receive_long(0x80000007), i);  // types 0 to 2
    ASSERT_EQ(infotype(), i % 3);
  }
}

void long_messages_head_to_head() {
  if (is_host()) return;
  const auto mine = pattern(1 << 19, static_cast<std::uint32_t>(mynode()));
  for (long other = 0; other < numnodes(); ++other) {
    if (other != mynode()) csend(1000 + mynode(), mine.data(), bytes_of(mine), other, 0);
  }
  std::vector<std::uint32_t> theirs(mine.size());
  for (long other = 0; other < numnodes(); ++other) {
    if (other == mynode()) continue;
    crecv(1000 + other, theirs.data(), bytes_of(theirs));
    ASSERT_EQ(theirs, pattern(mine.size(), static_cast<std::uint32_t>(other)));
  }
}

void a_big_message_arrives_whole() {
  constexpr std::size_t kWords = 64 * 1024 * 1024 / sizeof(std::uint32_t);
  if (is_host()) {
    const auto data = pattern(kWords, 4711);
    csend(5, data.data(), bytes_of(data), 0, 0);
    msgwait(isend(6, data.data(), bytes_of(data), 0, 0));
  }
  if (mynode() != 0) return;
  std::vector<std::uint32_t> data(kWords);
  for (const long type : {5L, 6L}) {
    std::fill(data.begin(), data.end(), 0);
    crecv(type, data.data(), bytes_of(data));
    ASSERT_TRUE(data == pattern(kWords, 4711));
  }
}

void messages_may_be_empty() {
  if (is_host()) csend(9, nullptr, 0, -1, 0);
  if (is_host()) return;
  cprobe(9);
  EXPECT_EQ(infocount(), 0);
  crecv(9, nullptr, 0);
  EXPECT_EQ(infonode(), myhost());
  EXPECT_EQ(infocount(), 0);
}

void typesel_picks_from_what_waits() {
  const std::vector<long> types = {29, 31, 0, 999'999'999, 2, 30};
  if (is_host()) {
    for (const long type : types) send_long(type, type, -1);
    return;
  }
  const auto expect_next = [](long typesel, long type) {
    EXPECT_EQ(receive_long(typesel), type);
    EXPECT_EQ(infotype(), type);
  };
  expect_next(30, 30);
  expect_next(0x80000007, 0);   // types 0 to 2, as programs for 32 bits wrote it
  expect_next(0xc0000000, 31);  // bit 30: from 30 up
  expect_next(0xe0000000, 29);  // bits 29 and 30
  expect_next(-1, 999'999'999);
  expect_next(-1, 2);
}

constexpr long kForce = 1'073'741'824;

void force_messages_need_a_posted_receive() {
  if (is_host()) {
    send_long(kForce, 1, -1);  // nobody waits for it
    send_long(1, 2, -1);
    for (long node = 0; node < numnodes(); ++node) receive_long(2);
    send_long(kForce, 3, -1);
    send_long(1, 4, -1);
    return;
  }
  EXPECT_EQ(receive_long(-1), 2);
  EXPECT_EQ(iprobe(kForce), 0);
  long forced = 0;
  const long mid = irecv(kForce, &forced, sizeof forced);
  send_long(2, 0, myhost());
  EXPECT_EQ(receive_long(-1), 4);
  msgwait(mid);
  EXPECT_EQ(forced, 3);
  EXPECT_EQ(infotype(), kForce);
}

void receives_match_in_order_of_posting() {
  if (is_host()) {
    receive_long(4);
    send_long(40, 1, 0);
    send_long(41, 2, 0);
    send_long(40, 3, 0);
  }
  if (mynode() != 0) return;
  long first = 0, second = 0, third = 0;
  const long any = irecv(-1, &first, sizeof first);
  const long forty = irecv(40, &second, sizeof second);
  const long later = irecv(-1, &third, sizeof third);
  send_long(4, 0, myhost());
  msgwait(later);
  EXPECT_EQ(infotype(), 41);
  msgwait(any);
  msgwait(forty);
  EXPECT_EQ(infotype(), 40);
  EXPECT_EQ(first, 1);
  EXPECT_EQ(second, 3);
  EXPECT_EQ(third, 2);
}

void message_ids_end_once_done() {
  if (is_host()) return;
  const std::vector<std::uint32_t> out = pattern(100'000, 1);
  std::vector<std::uint32_t> in(out.size());
  const long next = (mynode() + 1) % numnodes();
  const long sending = isend(50, out.data(), bytes_of(out), next, 0);
  const long receiving = irecv(50, in.data(), bytes_of(in));
  EXPECT_NE(sending, receiving);
  while (msgdone(receiving) == 0) flick();
  EXPECT_EQ(in, out);
  EXPECT_EQ(infocount(), bytes_of(in));
  msgwait(sending);
  expect_in(failure_of([&] { msgwait(sending); }), {"msgwait", "no message id " + std::to_string(sending)});
  expect_in(failure_of([&] { msgdone(receiving); }), {"msgdone", "no message id"});
  expect_in(failure_of([&] { msgdone(-1); }), {"no message id -1"});
}

void many_message_ids_at_once() {
  constexpr int kIds = 1000;
  if (mynode() == 0) {
    std::vector<long> values(kIds), mids;
    for (int i = 0; i < kIds; ++i) mids.push_back(irecv(100 + i, &values[i], sizeof values[i]));
    send_long(3, 0, myhost());
    for (int i = kIds - 1; i >= 0; --i) msgwait(mids[i]);
    for (int i = 0; i < kIds; ++i) ASSERT_EQ(values[i], i);
  }
  if (!is_host()) return;
  receive_long(3);
  std::vector<long> values(kIds), mids;
  std::iota(values.begin(), values.end(), 0);
  for (int i = 0; i < kIds; ++i) mids.push_back(isend(100 + i, &values[i], sizeof values[i], 0, 0));
  for (const long mid : mids) msgwait(mid);
}

void probes_describe_without_taking() {
  if (is_host()) {
    const auto data = pattern(1000, 3);
    csend(60, data.data(), bytes_of(data), -1, 0);
    csend(61, data.data(), 400, -1, 0);
    return;
  }
  cprobe(61);
  EXPECT_EQ(infocount(), 400);
  EXPECT_EQ(iprobe(62), 0);
  EXPECT_EQ(iprobe(-1), 1);
  EXPECT_EQ(infotype(), 60);
  EXPECT_EQ(infocount(), 4000);
  EXPECT_EQ(infonode(), myhost());
  std::vector<std::uint32_t> data(1000);
  crecv(60, data.data(), bytes_of(data));
  EXPECT_EQ(data, pattern(1000, 3));
  crecv(61, data.data(), bytes_of(data));
  EXPECT_EQ(infocount(), 400);
}

void a_message_is_never_cut() {
  if (is_host()) {
    const auto data = pattern(50, 2);
    csend(70, data.data(), bytes_of(data), -1, 0);
    return;
  }
  std::vector<std::uint32_t> data(50);
  for (int look = 0; look < 2; ++look) {  // as it arrives, and from the queue
    expect_in(
        failure_of([&] { crecv(70, data.data(), 100); }),
        {"node " + std::to_string(mynode()), "crecv", "200 bytes", "100 bytes", "type 70", "from the host"});
    EXPECT_EQ(iprobe(71), 0);
  }
  crecv(70, data.data(), 200);
  EXPECT_EQ(data, pattern(50, 2));
}

void wrong_arguments_are_told() {
  long x = 0;
  const std::string who = is_host() ? "the host" : "node " + std::to_string(mynode());
  expect_in(failure_of([&] { csend(1'000'000'000, &x, 8, 0, 0); }), {who, "csend", "1000000000", "reserved"});
  expect_in(failure_of([&] { csend(-1, &x, 8, 0, 0); }), {"type -1"});
  expect_in(failure_of([&] { isend(2'000'000'000, &x, 8, 0, 0); }), {"isend", "2000000000"});
  expect_in(failure_of([&] { csend(1, &x, -8, 0, 0); }), {"length -8"});
  expect_in(failure_of([&] { csend(1, &x, 8, numnodes() + 1, 0); }),
            {"no node " + std::to_string(numnodes() + 1)});
  expect_in(failure_of([&] { csend(1, &x, 8, -2, 0); }), {"no node -2"});
  expect_in(failure_of([&] { csend(1, &x, 8, 0, 3); }), {"pid 3"});
  expect_in(failure_of([&] { crecv(1'000'000'001, &x, 8); }), {"crecv", "1000000001", "reserved"});
  expect_in(failure_of([&] { irecv(1, &x, -1); }), {"irecv", "length -1"});
  expect_in(failure_of([&] { cprobe(2'000'000'001); }), {"cprobe", "reserved"});
  if (is_host()) expect_in(failure_of([&] { gsync(); }), {"the host", "gsync", "no part"});
}

void sums_and_maxima_of_all_nodes() {
  if (is_host()) return;
  const long n = numnodes();
  std::vector<long> whole(1000), whole_work(1000);
  std::vector<double> real(1000), high(1000), work(1000);
  for (int i = 0; i < 1000; ++i) {
    whole[i] = mynode() * i;
    real[i] = static_cast<double>(mynode()) * i;
    high[i] = (mynode() * 7 + i) % n - 3.0;
  }
  gisum(whole.data(), 1000, whole_work.data());
  gdsum(real.data(), 1000, work.data());
  gdhigh(high.data(), 1000, work.data());
  for (int i = 0; i < 1000; ++i) {
    ASSERT_EQ(whole[i], n * (n - 1) / 2 * i);
    ASSERT_EQ(real[i], static_cast<double>(n * (n - 1) / 2) * i);
    double highest = -4;
    for (int node = 0; node < n; ++node) highest = std::max(highest, (node * 7 + i) % n - 3.0);
    ASSERT_EQ(high[i], highest);
  }
}

// The order that hal/cube.h promises for sums, done by one.
double sum_in_order(std::vector<double> values) {
  const std::size_t corners = std::bit_floor(values.size());
  for (std::size_t i = corners; i < values.size(); ++i) values[i - corners] += values[i];
  for (std::size_t step = 1; step < corners; step <<= 1) {
    for (std::size_t i = 0; i < corners; i += 2 * step) values[i] += values[i + step];
  }
  return values[0];
}

double awkward(long node) {
  return 1.0 / (3 + static_cast<double>(node)) + 1e10 * static_cast<double>(node % 3);
}

void sums_have_the_same_bits_everywhere() {
  if (is_host()) return;
  std::vector<double> all;
  for (long node = 0; node < numnodes(); ++node) all.push_back(awkward(node));
  double x = awkward(mynode());
  double work = 0;
  gdsum(&x, 1, &work);
  EXPECT_EQ(std::bit_cast<std::uint64_t>(x), std::bit_cast<std::uint64_t>(sum_in_order(all)));
}

void every_part_of_the_machine_can_sum() {
  if (is_host()) return;
  for (int first = 0; first < numnodes(); ++first) {
    for (int count = 1; first + count <= numnodes(); ++count) {
      if (mynode() < first || mynode() >= first + count) continue;
      std::vector<double> x = {awkward(mynode()), -awkward(mynode())};
      std::vector<double> high = x;
      std::vector<double> work(2), all;
      for (int node = first; node < first + count; ++node) all.push_back(awkward(node));
      cube_sum({first, count}, x, work);
      cube_high({first, count}, high, work);
      ASSERT_EQ(x[0], sum_in_order(all));
      ASSERT_EQ(x[1], -sum_in_order(all));
      ASSERT_EQ(high[0], *std::max_element(all.begin(), all.end()));
      ASSERT_EQ(high[1], -*std::min_element(all.begin(), all.end()));
    }
  }
}

void collectives_do_not_mix_with_messages() {
  if (is_host()) return;
  const long next = (mynode() + 1) % numnodes();
  long any = 0;
  const long mid = irecv(-1, &any, sizeof any);
  long x = 1, work = 0;
  gisum(&x, 1, &work);
  EXPECT_EQ(x, numnodes());
  EXPECT_EQ(msgdone(mid), 0);
  gsync();
  send_long(80, 1234, next);
  msgwait(mid);
  EXPECT_EQ(any, 1234);
}

std::string part_of(long node) {
  return std::string(static_cast<std::size_t>(node * 5 % 7), static_cast<char>('a' + node));
}

void concatenations_are_in_node_order() {
  if (is_host()) return;
  std::string all;
  std::vector<long> lengths;
  for (long node = 0; node < numnodes(); ++node) {
    all += part_of(node);
    lengths.push_back(static_cast<long>(part_of(node).size()));
  }
  const std::string mine = part_of(mynode());
  for (int again = 0; again < 3; ++again) {
    std::string y(all.size() + 3, '-');
    long count = -1;
    gcol(mine.data(), static_cast<long>(mine.size()), y.data(), static_cast<long>(y.size()), &count);
    EXPECT_EQ(count, static_cast<long>(all.size()));
    EXPECT_EQ(y, all + "---");
    std::string z(all.size(), '-');
    gcolx(mine.data(), lengths.data(), z.data());
    EXPECT_EQ(z, all);
  }
  std::string y(all.size(), '-');
  long count = 0;
  if (all.empty()) return;
  expect_in(failure_of([&] {
              gcol(mine.data(), static_cast<long>(mine.size()), y.data(), static_cast<long>(all.size()) - 1,
                   &count);
            }),
            {"gcol", std::to_string(all.size()) + " bytes"});
}

void gsync_holds_all_until_the_last() {
  if (is_host()) return;
  if (mynode() == numnodes() - 1) std::this_thread::sleep_for(std::chrono::milliseconds(50));
  double last_to_come = dclock();
  gsync();
  const double left = dclock();
  double work = 0;
  gdhigh(&last_to_come, 1, &work);
  EXPECT_GE(left, last_to_come);
}

void nodes_of_a_machine_share_memory() {
  if (is_host()) return;
  const Neighbourhood here = neighbourhood();
  ASSERT_EQ(here.count, numnodes());  // these tests run on one machine
  EXPECT_EQ(here.machine, 0);
  EXPECT_EQ(here.index, mynode());
  for (const std::size_t size : {0, 1, 1000, 3'000'000}) {
    const SharedMemory memory(size);
    ASSERT_EQ(memory.bytes().size(), size);
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(memory.bytes().data()) % 64, 0u);
    for (std::size_t i = here.index; i < size; i += here.count)
      memory.bytes()[i] = static_cast<std::byte>(i % 251);
    gsync();
    for (std::size_t i = 0; i < size; ++i) ASSERT_EQ(memory.bytes()[i], static_cast<std::byte>(i % 251));
    gsync();
  }
}

void traffic_counts_what_is_sent() {
  const Traffic before = traffic();
  char bytes[100] = "";
  if (mynode() == 0) {
    csend(90, bytes, 100, -1, 0);
    csend(90, bytes, 7, myhost(), 0);
    msgwait(isend(90, bytes, 3, myhost(), 0));
    const auto nodes = static_cast<std::uint64_t>(numnodes() - 1);
    EXPECT_EQ(traffic().to_nodes.messages - before.to_nodes.messages, nodes);
    EXPECT_EQ(traffic().to_nodes.bytes - before.to_nodes.bytes, 100 * nodes);
    EXPECT_EQ(traffic().to_host.messages - before.to_host.messages, 2u);
    EXPECT_EQ(traffic().to_host.bytes - before.to_host.bytes, 10u);
    return;
  }
  crecv(90, bytes, 100);
  if (is_host()) crecv(90, bytes, 100);
  EXPECT_EQ(traffic().to_nodes.bytes, before.to_nodes.bytes);
}

double processor_seconds() {
  rusage usage = {};
  getrusage(RUSAGE_THREAD, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

void waiting_takes_little_processor_time() {
  const double before = processor_seconds();
  if (mynode() == 0) {
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    send_long(95, 0, myhost());
    send_long(95, 0, -1);
  } else {
    receive_long(95);
    EXPECT_LT(processor_seconds() - before, 0.15);
  }
}

void flick_gives_time_away() {
  const double before = processor_seconds();
  const double end = dclock() + 0.3;
  while (dclock() < end) flick();
  EXPECT_LT(processor_seconds() - before, 0.1);
}

void clocks_go_on() {
  const double seconds = dclock();
  const unsigned long milliseconds = mclock();
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  EXPECT_GE(dclock() - seconds, 0.019);
  EXPECT_GE(mclock() - milliseconds, 19u);
}

}  // namespace

void meet() {
  if (is_host()) {
    for (long node = 0; node < numnodes(); ++node) receive_long(999'000'001);
    send_long(999'000'002, 0, -1);
  } else {
    send_long(999'000'001, 0, myhost());
    receive_long(999'000'002);
  }
}

std::vector<NxBody> nx_bodies() {
#define BODY(function) \
  NxBody { #function, function }
  return {BODY(ranks_know_themselves),
          BODY(messages_go_round_a_ring),
          BODY(host_talks_with_every_node),
          BODY(minus_one_is_all_other_nodes),
          BODY(a_rank_sends_to_itself),
          BODY(ten_thousand_messages_stay_in_order),
          BODY(long_messages_head_to_head),
          BODY(a_big_message_arrives_whole),
          BODY(messages_may_be_empty),
          BODY(typesel_picks_from_what_waits),
          BODY(force_messages_need_a_posted_receive),
          BODY(receives_match_in_order_of_posting),
          BODY(message_ids_end_once_done),
          BODY(many_message_ids_at_once),
          BODY(probes_describe_without_taking),
          BODY(a_message_is_never_cut),
          BODY(wrong_arguments_are_told),
          BODY(sums_and_maxima_of_all_nodes),
          BODY(sums_have_the_same_bits_everywhere),
          BODY(every_part_of_the_machine_can_sum),
          BODY(collectives_do_not_mix_with_messages),
          BODY(concatenations_are_in_node_order),
          BODY(gsync_holds_all_until_the_last),
          BODY(nodes_of_a_machine_share_memory),
          BODY(traffic_counts_what_is_sent),
          BODY(waiting_takes_little_processor_time),
          BODY(flick_gives_time_away),
          BODY(clocks_go_on)};
#undef BODY
}

}  // namespace mars::hal
