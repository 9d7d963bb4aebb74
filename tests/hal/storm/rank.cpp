#include "tests/hal/storm/rank.h"

#include <algorithm>
#include <cerrno>
#include <iterator>
#include <stdexcept>
#include <string>

#include "hal/messages/message_types.h"
#include "hal/nx/nx_messages.h"
#include "tests/hal/storm/handlers.h"

namespace mars::storm {
namespace {

constexpr long kNever = 999'000'009;  // no such message is sent
constexpr std::size_t kPosted = 24;
constexpr std::size_t kSending = 8;
constexpr double kSeconds = 50;  // that a round may take

void expect(bool holds, const std::string& what) {
  if (!holds) throw std::runtime_error(what);
}

Came info() {
  return {static_cast<int>(infonode()), static_cast<std::int32_t>(infotype()), static_cast<std::size_t>(infocount())};
}

std::string text_of(const Came& came) {
  return "type " + std::to_string(came.type) + ", " + std::to_string(came.length) + " bytes, from " +
         std::to_string(came.from);
}

}  // namespace

Rank::Rank(std::uint32_t seed)
    : seed_(seed),
      me_(static_cast<int>(mynode())),
      nodes_(static_cast<int>(numnodes())),
      random_(seed * 7919u + static_cast<std::uint32_t>(me_)),
      ledger_(seed, me_) {
  handle_for(me_, this);
}

Rank::~Rank() { handle_for(me_, nullptr); }

void Rank::run(int round) {
  start(round);
  meet();
  while (next_send_ < sends_.size()) step();
  finish();
}

void Rank::start(int round) {
  deadline_ = dclock() + kSeconds;
  ledger_.open(round, nodes_);
  sends_ = sends_of(seed_, round, me_, nodes_);
  next_send_ = 0;
  order_ = 0;
  for (int rank = 0; rank < nodes_; ++rank) {
    sent_all_.push_back(irecv(kSentAll, nullptr, 0));
    got_all_.push_back(irecv(kGotAll, nullptr, 0));
  }
}

void Rank::step() {
  struct Weighted {
    std::size_t weight;
    void (Rank::*step)();
  };
  static constexpr Weighted kSteps[] = {
      {12, &Rank::send_next},     {10, &Rank::post},  {6, &Rank::post_handler}, {10, &Rank::probe_and_receive},
      {10, &Rank::ask},           {4, &Rank::cancel}, {2, &Rank::flush},        {3, &Rank::mask},
      {3, &Rank::wait_for_a_send}};
  std::size_t left = below(random_, 60);
  for (const Weighted& one : kSteps) {
    if (left < one.weight) {
      (this->*one.step)();
      return collect_fired();
    }
    left -= one.weight;
  }
}

void Rank::send_next() {
  const Send& send = sends_[next_send_];
  const auto length = static_cast<long>(send.length);
  Bytes bytes = contents(seed_, me_, send.number, send.length);
  const auto free = std::find(sending_by_.begin(), sending_by_.end(), false) - sending_by_.begin();
  const std::size_t way = below(random_, 3);
  if (way == 0) {
    csend(send.type, bytes.data(), length, send.to, 0);
    bytes.assign(bytes.size(), 0xdd);  // it is ours again
  } else if (way == 1 || free == kHandlers) {
    if (sending_.size() >= kSending) wait_for_a_send();
    const long mid = isend(send.type, bytes.data(), length, send.to, 0);
    sending_.push_back({mid, std::move(bytes)});
  } else {
    sending_by_[free] = true;
    handed_[free] = std::move(bytes);
    reported_[free] = {send.to, send.type, send.length};
    hsend(send.type, handed_[free].data(), length, send.to, 0, send_handler(static_cast<int>(free)));
  }
  ++next_send_;
}

void Rank::wait_for_a_send() {
  if (sending_.empty()) return;
  const auto at = sending_.begin() + static_cast<long>(below(random_, sending_.size()));
  if (maybe(2))
    msgwait(at->first);
  else if (msgdone(at->first) == 0)
    return;
  sending_.erase(at);
}

void Rank::post() {
  if (receives_.size() >= kPosted) return;
  const Masked masked(*this);  // or a handler's hrecv could come before
  Receive* receive = new_receive();
  if (receive == nullptr) return;
  receive->mid = irecv(receive->taker.typesel, receive->buffer.get(), static_cast<long>(receive->capacity));
}

void Rank::post_handler() {
  const auto free = std::find(receiving_by_.begin(), receiving_by_.end(), nullptr) - receiving_by_.begin();
  if (free == kHandlers) return;
  Receive* receive = new_receive();
  if (receive == nullptr) return;
  receive->handler = static_cast<int>(free);
  receiving_by_[free] = receive;
  hrecv(receive->taker.typesel, receive->buffer.get(), static_cast<long>(receive->capacity),
        receive_handler(receive->handler));
}

// With a random typesel; nullptr where there is no buffer for it.
Receive* Rank::new_receive() {
  const std::int32_t typesel = any_typesel(random_);
  const std::size_t capacity = capacity_for(typesel);
  const Buffers::Buffer buffer = buffers_.get(capacity);
  if (buffer == nullptr) return nullptr;
  return &receives_.emplace_back(Receive{{++order_, typesel}, capacity, buffer, -1, -1});
}

void Rank::received(int handler, const Came& came) {
  Receive* receive = receiving_by_[handler];
  expect(masked_ == 0, "a handler ran though masked");
  expect(receive != nullptr, "a handler ran without its hrecv, or twice");
  expect(!receive->fired, "the handler of an hrecv ran twice");
  receive->fired = true;
  receive->came = came;
  if (maybe(3)) post_handler();
}

void Rank::sent(int handler, const Came& came) {
  expect(masked_ == 0, "a handler ran though masked");
  expect(sending_by_[handler], "the handler of an hsend ran twice");
  expect(came == reported_[handler], "the handler of an hsend got " + text_of(came));
  sending_by_[handler] = false;
}

void Rank::probe_and_receive() {
  const Masked masked(*this);  // or a handler's hrecv could take what the probe found
  const std::int32_t typesel = any_typesel(random_);
  if (iprobe(typesel) == 1) {
    const Came probed = info();
    expect(messages::selects(typesel, probed.type), "a probe found " + text_of(probed));
    expect(!kind_of(probed.type).force(), "a probe found a force message");
    expect(!maybe(4) || (iprobe(typesel) == 1 && info() == probed), "a second probe found " + text_of(info()));
    if (maybe(4) && probed.length > 0) expect_untouched_by_short(typesel, probed);
    receive_now(typesel, probed.length, &probed);
  }
}

void Rank::expect_untouched_by_short(std::int32_t typesel, const Came& probed) {
  const Bytes untouched(probed.length - 1, 0xee);
  Bytes bytes = untouched;
  errno = 0;
  expect(_crecv(typesel, bytes.data(), static_cast<long>(bytes.size())) == -1 && errno == EQMSGLONG,
         "a receive that is too short did not fail");
  expect(bytes == untouched, "a receive that is too short wrote to its buffer");
}

// By crecv; where a probe has found a message it is that one.
void Rank::receive_now(std::int32_t typesel, std::size_t capacity, const Came* probed) {
  const Buffers::Buffer bytes = for_now_.get(capacity);
  crecv(typesel, bytes.get(), static_cast<long>(capacity));
  const Came came = info();
  expect(probed == nullptr || came == *probed, "not what the probe found was received but " + text_of(came));
  account({++order_, typesel}, came, bytes.get());
}

void Rank::ask() {
  if (receives_.empty()) return;
  const auto at = std::next(receives_.begin(), static_cast<long>(below(random_, receives_.size())));
  if (at->mid >= 0) ask(at);
}

// Whether it is done; then it is accounted for and gone.
bool Rank::ask(Receives::iterator at) {
  if (msgdone(at->mid) == 0) return false;
  const Came came = info();
  Receive receive = std::move(*at);
  receives_.erase(at);
  account(receive.taker, came, receive.buffer.get());
  return true;
}

void Rank::account(const Taker& taker, const Came& came, const unsigned char* bytes) {
  expect(messages::selects(taker.typesel, came.type),
         "a receive of typesel " + std::to_string(taker.typesel) + " got " + text_of(came));
  settle_before(taker, came);
  ledger_.received(taker, came, bytes);
}

// Every receive that was posted earlier and selects what came later must have got its message by now.
void Rank::settle_before(const Taker& taker, const Came& came) {
  const auto earlier = [&](const Receive& receive) {
    return receive.taker.order < taker.order && messages::selects(receive.taker.typesel, came.type);
  };
  const std::string passed = text_of(came) + " passed by a receive that was posted earlier";
  for (;;) {
    const auto at = std::find_if(receives_.begin(), receives_.end(), earlier);
    if (at == receives_.end()) return;
    if (at->mid >= 0) {
      expect(ask(at), passed + ", an irecv");
      continue;
    }
    if (!at->fired) run_handlers();
    expect(at->fired, passed + ", an hrecv");
    Receive receive = std::move(*at);
    receives_.erase(at);
    receiving_by_[receive.handler] = nullptr;
    account(receive.taker, receive.came, receive.buffer.get());
  }
}

// Those whose handlers have run.
void Rank::collect_fired() {
  for (;;) {
    const auto at = std::find_if(receives_.begin(), receives_.end(), [](const Receive& one) { return one.fired; });
    if (at == receives_.end()) return;
    Receive receive = std::move(*at);
    receives_.erase(at);
    receiving_by_[receive.handler] = nullptr;
    account(receive.taker, receive.came, receive.buffer.get());
  }
}

// Those of all messages that have come.
void Rank::run_handlers() {
  const long before = set_mask(0);
  expect(iprobe(kNever) == 0, "a message came that nobody sends");
  set_mask(before);
}

void Rank::cancel() {
  if (receives_.empty()) return;
  const auto at = std::next(receives_.begin(), static_cast<long>(below(random_, receives_.size())));
  if (at->mid < 0 || ask(at)) return;
  const long mid = at->mid;
  msgcancel(mid);
  receives_.erase(at);
  errno = 0;
  expect(_msgdone(mid) == -1 && errno == EQMID, "a cancelled id still stands for something");
}

void Rank::flush() {
  std::vector<std::int32_t> types;
  for (const Kind& kind : kinds())
    if (kind.flushed) types.push_back(kind.type);
  const std::int32_t type = types[below(random_, types.size())];
  const int node = static_cast<int>(below(random_, static_cast<std::size_t>(nodes_) + 2)) - 1;
  ledger_.flushed(type, node);
  flushmsg(type, node, 0);
}

void Rank::mask() { set_mask(maybe(3) ? 1 : 0); }

// Handlers that were held back may run in the call that unmasks them.
long Rank::set_mask(long state) {
  const long before = masked_;
  if (state == 0) masked_ = 0;
  expect(masktrap(state) == before, "masktrap did not return what was before");
  masked_ = state;
  return before;
}

void Rank::check_time() const {
  if (dclock() < deadline_) return;
  throw std::runtime_error("after " + std::to_string(static_cast<int>(kSeconds)) + " s " +
                           std::to_string(ledger_.owed()) + " messages are still owed, " +
                           std::to_string(sent_all_.size()) + " ranks still to be done");
}

}  // namespace mars::storm
