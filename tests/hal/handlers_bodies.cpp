// Bodies of what NX says of handlers: hsend, hrecv, hsendrecv, masktrap.
#include "tests/hal/nx_bodies.h"

#include <cerrno>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "hal/nx/nx_global.h"
#include "hal/nx/nx_paragon.h"

namespace mars::hal {
namespace {

bool is_host() { return mynode() == myhost(); }

int errno_of(long result) {
  EXPECT_EQ(result, -1);
  return result == -1 ? errno : 0;
}

void send_long(long type, long value, long to) { csend(type, &value, sizeof value, to, 0); }

long receive_long(long typesel) {
  long value = -1;
  crecv(typesel, &value, sizeof value);
  return value;
}

long next_node() { return (mynode() + 1) % numnodes(); }
long previous_node() { return (mynode() + numnodes() - 1) % numnodes(); }

// The state of handlers: each rank's own, whether ranks are threads or processes.
thread_local long counter = 0;
thread_local long draws_left = 0;
thread_local long request_buffer = 0;

void serve(long type, long length, long node, long pid) {
  EXPECT_EQ(type, 20);
  EXPECT_EQ(length, static_cast<long>(sizeof(long)));
  EXPECT_EQ(infonode(), node);
  EXPECT_EQ(infotype(), type);
  EXPECT_EQ(infocount(), length);
  counter += request_buffer;
  send_long(21, counter, node);
  EXPECT_EQ(pid, 0);
  if (--draws_left > 0) hrecv(20, &request_buffer, sizeof request_buffer, serve);
}

// Node 0's counter, for so many draws.
void open_counter(long draws) {
  counter = 0;
  draws_left = draws;
  if (mynode() == 0 && draws > 0) hrecv(20, &request_buffer, sizeof request_buffer, serve);
}

// Every node draws 100 numbers of node 0's counter, which itself waits for other messages.
void a_handler_serves_a_counter() {
  constexpr long kDraws = 100;
  if (is_host()) return;
  open_counter(kDraws * (numnodes() - 1));
  gsync();
  long last = 0;
  for (long draw = 0; mynode() != 0 && draw < kDraws; ++draw) {
    send_long(20, 1, 0);
    const long now = receive_long(21);
    EXPECT_GT(now, last);
    last = now;
  }
  if (mynode() != 0) send_long(22, last, 0);
  for (long node = 1; mynode() == 0 && node < numnodes(); ++node) {
    receive_long(22);
    EXPECT_EQ(infotype(), 22);  // not what the handlers received meanwhile
  }
  gsync();
  if (mynode() != 0) return;
  EXPECT_EQ(counter, kDraws * (numnodes() - 1));
}

thread_local std::string heard;
thread_local long heard_buffer[4];

void hear(long type, long, long, long) { heard += std::to_string(type) + " "; }

// Calls what is due and takes what has arrived.
void look_around() { iprobe(999'999'998); }

void handlers_run_in_the_order_of_their_messages_and_once() {
  if (is_host()) return;
  heard.clear();
  for (long i = 0; i < 3; ++i) hrecv(32 - i, &heard_buffer[i], sizeof(long), hear);
  for (long type = 30; type < 33; ++type) send_long(type, type, mynode());
  send_long(30, 4, mynode());
  EXPECT_EQ(receive_long(30), 4);
  EXPECT_EQ(heard, "30 31 32 ");
  EXPECT_EQ(heard_buffer[0], 32);
  EXPECT_EQ(heard_buffer[2], 30);
}

void masked_handlers_wait() {
  if (is_host()) return;
  heard.clear();
  EXPECT_EQ(masktrap(1), 0);
  hrecv(33, heard_buffer, sizeof(long), hear);
  send_long(33, 1, mynode());
  send_long(34, 2, mynode());
  EXPECT_EQ(receive_long(34), 2);
  EXPECT_EQ(heard, "");
  EXPECT_EQ(heard_buffer[0], 1);  // it has come, but is not told
  EXPECT_EQ(masktrap(1), 1);
  EXPECT_EQ(heard, "");
  EXPECT_EQ(_masktrap(0), 1);
  EXPECT_EQ(heard, "33 ");
  EXPECT_EQ(masktrap(0), 0);
}

void hear_slowly(long type, long, long, long) {
  heard += "<";
  send_long(37, 5, mynode());
  EXPECT_EQ(receive_long(37), 5);
  flick();
  heard += std::to_string(type) + ">";
}

void handlers_do_not_nest() {
  if (is_host()) return;
  heard.clear();
  hrecv(35, heard_buffer, sizeof(long), hear_slowly);
  hrecv(36, heard_buffer + 1, sizeof(long), hear_slowly);
  send_long(35, 1, mynode());
  send_long(36, 1, mynode());
  send_long(38, 1, mynode());
  receive_long(38);
  look_around();
  EXPECT_EQ(heard, "<35><36>");
}

void handlers_run_while_a_collective_waits() {
  if (is_host()) return;
  heard.clear();
  if (mynode() == 0) hrecv(39, heard_buffer, sizeof(long), hear);
  long x = 1, work = 0;
  if (mynode() == numnodes() - 1) send_long(39, 1, 0);
  gisum(&x, 1, &work);
  gsync();
  EXPECT_EQ(x, numnodes());
  look_around();
  EXPECT_EQ(heard, mynode() == 0 ? "39 " : "");
}

// Each other node comes only after node 0's handler has answered it.
void a_handler_serves_while_a_collective_waits() {
  if (is_host()) return;
  long x = 1, work = 0;
  open_counter(2 * (numnodes() - 1));
  if (mynode() != 0) {
    send_long(20, 1, 0);
    receive_long(21);
  }
  gisum(&x, 1, &work);
  EXPECT_EQ(x, numnodes());
  if (mynode() != 0) {
    send_long(20, 1, 0);
    receive_long(21);
  }
  gsync();
  EXPECT_EQ(counter, mynode() == 0 ? 2 * (numnodes() - 1) : 0);
}

thread_local long told[4];

void note(long type, long length, long node, long pid) {
  told[0] = type;
  told[1] = length;
  told[2] = node;
  told[3] = pid;
}

void sends_have_handlers() {
  if (is_host()) return;
  const std::vector<long> data(50'000, mynode());
  std::vector<long> in(data.size());
  const auto bytes = static_cast<long>(data.size() * sizeof(long));
  told[0] = 0;
  hsend(40, data.data(), bytes, next_node(), 0, note);
  crecv(40, in.data(), bytes);
  while (told[0] == 0) flick();
  EXPECT_EQ(told[0], 40);
  EXPECT_EQ(told[1], bytes);
  EXPECT_EQ(told[2], next_node());
  EXPECT_EQ(in[7], previous_node());

  told[0] = 0;
  hsendrecv(41, data.data(), 80, next_node(), 0, 41, in.data(), bytes, note);
  while (told[0] == 0) flick();
  EXPECT_EQ(told[0], 41);
  EXPECT_EQ(told[1], 80);
  EXPECT_EQ(told[2], previous_node());
  EXPECT_EQ(infotype(), 40);  // the handler's own was another
  EXPECT_EQ(errno_of(_hsend(42, nullptr, 0, 0, 0, nullptr)), EQPBUF);
  EXPECT_EQ(errno_of(_hrecv(1'000'000'000, nullptr, 0, note)), EQTYPE);
  EXPECT_EQ(errno_of(_hsendrecv(1, nullptr, 0, -7, 0, 1, nullptr, 0, note)), EQNODE);
}

void a_handler_whose_message_is_too_long_fails_the_call_in_which_it_is_due() {
  if (is_host()) return;
  hrecv(43, heard_buffer, 1, hear);
  send_long(43, 77, mynode());
  long value = 0;
  EXPECT_EQ(errno_of(_crecv(44, &value, sizeof value)), EQMSGLONG);
  EXPECT_EQ(receive_long(43), 77);
  send_long(44, 5, mynode());  // the crecv that failed does not take it
  EXPECT_EQ(receive_long(44), 5);
  EXPECT_EQ(value, 0);
}

thread_local long parameter_told = 0;

void note_parameter(long, long, long, long, long parameter) { parameter_told = parameter; }

void paragon_handlers_have_a_parameter() {
  if (is_host()) return;
  long first = 0;
  hrecvx(65, &first, sizeof first, mynode(), 0, note_parameter, 4711);
  send_long(65, 1, mynode());
  look_around();
  EXPECT_EQ(parameter_told, 4711);
  hsendx(66, &first, sizeof first, mynode(), 0, note_parameter, 12);
  receive_long(66);
  look_around();
  EXPECT_EQ(parameter_told, 12);
}

}  // namespace

std::vector<NxBody> handlers_bodies() {
#define BODY(function) \
  NxBody { #function, function }
  return {BODY(a_handler_serves_a_counter),
          BODY(handlers_run_in_the_order_of_their_messages_and_once),
          BODY(masked_handlers_wait),
          BODY(handlers_do_not_nest),
          BODY(handlers_run_while_a_collective_waits),
          BODY(a_handler_serves_while_a_collective_waits),
          BODY(sends_have_handlers),
          BODY(a_handler_whose_message_is_too_long_fails_the_call_in_which_it_is_due),
          BODY(paragon_handlers_have_a_parameter)};
#undef BODY
}

}  // namespace mars::hal
