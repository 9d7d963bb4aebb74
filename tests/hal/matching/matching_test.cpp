// Matching as a process does it against a naive model: random arrivals and calls, each call's result predicted.
#include <algorithm>
#include <cerrno>
#include <iterator>
#include <list>
#include <map>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "hal/messages/process.h"
#include "hal/nx/nx_messages.h"
#include "hal/nx/nx_paragon.h"
#include "tests/hal/matching/model.h"
#include "tests/hal/matching/scripted_backend.h"

namespace mars::messages {
namespace {

using model::Message;
using model::Model;
using model::Receive;

constexpr std::size_t kCapacity = 24;
constexpr long kNever = 77;

struct Ran {
  long handler, type, len, node;
};
std::vector<Ran> ran;

void note(long type, long len, long node, long, long handler) { ran.push_back({handler, type, len, node}); }

class Game {
 public:
  explicit Game(std::uint32_t seed) : random_(seed), lazy_(seed % 2 == 1), process_(backend_) { ran.clear(); }

  void play() {
    static constexpr void (Game::*kMoves[])() = {
        &Game::arrive, &Game::arrive, &Game::arrive,  &Game::post,   &Game::post,  &Game::post_handler, &Game::ask,
        &Game::ask,    &Game::probe,  &Game::receive, &Game::cancel, &Game::flush, &Game::mask};
    for (int turn = 0; turn < 300 && !testing::Test::HasFailure(); ++turn) {
      (this->*kMoves[below(std::size(kMoves))])();
      if (!lazy_) settle();
    }
    settle();
  }

 private:
  using Bytes = ScriptedBackend::Bytes;

  std::size_t below(std::size_t end) { return random_() % end; }
  template <class T, std::size_t n>
  T any(const T (&all)[n]) {
    return all[below(n)];
  }

  long any_typesel() {
    return any({0L, 1L, 2L, 29L, 30L, 5000L, 1'073'741'824L, -1L, 0x80000003L, 0x80000006L, -0x40000000L, 0xe0000001L});
  }
  long any_node() { return below(3) == 0 ? static_cast<long>(below(4)) : -1; }

  // Everything that has arrived goes where it belongs, and every handler that may runs.
  void settle() {
    EXPECT_EQ(iprobe(kNever), 0);
    if (masked_) return;
    EXPECT_EQ(ran.size(), model_.due.size());
    for (std::size_t i = 0; i < std::min(ran.size(), model_.due.size()); ++i) {
      EXPECT_EQ(ran[i].handler, model_.due[i]);
      const auto of = std::find_if(model_.receives.begin(), model_.receives.end(), [&](const Receive& one) {
        return one.kind == Receive::by_handler && one.name == ran[i].handler;
      });
      ASSERT_NE(of, model_.receives.end());
      EXPECT_EQ(ran[i].type, of->got->type);
      EXPECT_EQ(ran[i].node, of->got->from);
      expect_contents(*of->got, handed_.at(of->name));
      model_.receives.erase(of);
    }
    ran.clear();
    model_.due.clear();
  }

  void arrive() {
    const Message message{++arrived_, static_cast<int>(below(4)),
                          any({0, 1, 2, 29, 30, 5000, 999'999'999, 1'073'741'824}), below(17)};
    if (message.force()) settle();  // whether it is discarded depends on what has been posted
    backend_.hand(message.from, message.type, Bytes(message.length, static_cast<unsigned char>(message.number)));
    model_.arrives(message);
    if (message.force()) settle();
  }

  void post() {
    Receive receive{Receive::by_id, -1, any_typesel(), any_node(), below(kCapacity)};
    auto bytes = std::make_unique<Bytes>(kCapacity, 0xee);
    const long capacity = static_cast<long>(receive.capacity);
    receive.name = receive.node == -1 && below(2) == 0
                       ? irecv(receive.typesel, bytes->data(), capacity)
                       : irecvx(receive.typesel, bytes->data(), capacity, receive.node, -1, nullptr);
    posted_[receive.name] = std::move(bytes);
    model_.post(receive);
  }

  void post_handler() {
    settle();  // handlers run in the order in which messages are seen
    const Receive receive{Receive::by_handler, ++handlers_, any_typesel(), any_node(), kCapacity};
    handed_[receive.name].assign(kCapacity, 0xee);
    model_.post(receive);
    hrecvx(receive.typesel, handed_[receive.name].data(), static_cast<long>(receive.capacity), receive.node, -1, note,
           receive.name);
  }

  std::list<Receive>::iterator any_posted() {
    std::vector<std::list<Receive>::iterator> all;
    for (auto at = model_.receives.begin(); at != model_.receives.end(); ++at)
      if (at->kind == Receive::by_id) all.push_back(at);
    return all.empty() ? model_.receives.end() : all[below(all.size())];
  }

  void ask() {
    const auto at = any_posted();
    if (at == model_.receives.end()) return;
    const bool may_wait = at->got || at->too_short;
    errno = 0;
    const long result = may_wait && below(2) == 0 ? 1 + _msgwait(at->name) * 2 : _msgdone(at->name);
    if (at->too_short) {
      EXPECT_LT(result, 0);
      EXPECT_EQ(errno, EQMSGLONG);
      EXPECT_EQ(*posted_[at->name], Bytes(kCapacity, 0xee));
    } else if (!at->got) {
      EXPECT_EQ(result, 0);
      return;
    } else {
      EXPECT_EQ(result, 1);
      expect_info(*at->got);
      expect_contents(*at->got, *posted_[at->name]);
    }
    EXPECT_EQ(_msgdone(at->name), -1);
    posted_.erase(at->name);
    model_.receives.erase(at);
  }

  void probe() {
    const long typesel = any_typesel(), node = any_node();
    const Message* message = model_.first(typesel, node);
    const long found = node == -1 ? iprobe(typesel) : iprobex(typesel, node, -1, nullptr);
    EXPECT_EQ(found, message != nullptr);
    if (found == 1 && message != nullptr) expect_info(*message);
  }

  // Where a message waits; else it would wait for ever.
  void receive() {
    const long typesel = any_typesel(), node = any_node();
    const Message* first = model_.first(typesel, node);
    if (first == nullptr) return;
    const Message message = *first;
    const std::size_t capacity = below(kCapacity);
    Bytes bytes(kCapacity, 0xee);
    errno = 0;
    const long result = node == -1 ? _crecv(typesel, bytes.data(), static_cast<long>(capacity))
                                   : _crecvx(typesel, bytes.data(), static_cast<long>(capacity), node, -1, nullptr);
    if (message.length > capacity) {
      EXPECT_EQ(result, -1);
      EXPECT_EQ(errno, EQMSGLONG);
      EXPECT_EQ(bytes, Bytes(kCapacity, 0xee));
      return;
    }
    EXPECT_EQ(result, 0);
    expect_info(message);
    expect_contents(message, bytes);
    model_.remove(message.number);
  }

  void cancel() {
    settle();
    const auto at = any_posted();
    if (at == model_.receives.end()) return;
    const long mid = at->name;
    model_.cancel(at);
    msgcancel(mid);
    EXPECT_EQ(_msgdone(mid), -1);
    posted_.erase(mid);
  }

  void flush() {
    const long typesel = any_typesel(), node = any_node();
    flushmsg(typesel, node, -1);
    while (const Message* message = model_.first(typesel, node)) model_.remove(message->number);
  }

  void mask() {
    const bool masked = below(2) == 0;
    EXPECT_EQ(masktrap(masked), masked_);
    masked_ = masked;
    if (!masked) settle();
  }

  static void expect_info(const Message& message) {
    EXPECT_EQ(infotype(), message.type);
    EXPECT_EQ(infonode(), message.from);
    EXPECT_EQ(infocount(), static_cast<long>(message.length));
  }

  static void expect_contents(const Message& message, const Bytes& bytes) {
    Bytes wanted(kCapacity, 0xee);
    std::fill_n(wanted.begin(), message.length, static_cast<unsigned char>(message.number));
    EXPECT_EQ(bytes, wanted);
  }

  std::mt19937 random_;
  const bool lazy_;  // messages are seen only when a call looks for them
  ScriptedBackend backend_;
  Process process_;
  Model model_;
  std::map<long, std::unique_ptr<Bytes>> posted_;  // by id
  std::map<long, Bytes> handed_;                   // by handler
  bool masked_ = false;
  int arrived_ = 0;
  long handlers_ = 0;
};

TEST(Matching, AgreesWithANaiveModel) {
  for (std::uint32_t seed = 1; seed <= 300 && !testing::Test::HasFailure(); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Game(seed).play();
  }
}

TEST(Matching, AgreesWithANaiveModelFresh) {
  const auto wanted = static_cast<std::uint32_t>(GTEST_FLAG_GET(random_seed));
  const std::uint32_t seed = wanted != 0 ? wanted : std::random_device()() % 99'999 + 1;
  SCOPED_TRACE("GTEST_RANDOM_SEED=" + std::to_string(seed) + " plays it again");
  Game(seed).play();
}

// Also of those that came between two looks of one call.
TEST(Matching, HandlersRunInTheOrderOfTheirMessages) {
  ran.clear();
  ScriptedBackend backend;
  Process process(backend);
  hrecvx(1, nullptr, 0, -1, -1, note, 1);
  hrecvx(2, nullptr, 0, -1, -1, note, 2);
  backend.hand(1, 2, {});
  backend.hand(1, 1, {});
  backend.be_blind(1);
  EXPECT_EQ(iprobe(kNever), 0);
  EXPECT_EQ(iprobe(kNever), 0);
  ASSERT_EQ(ran.size(), 2u);
  EXPECT_EQ(ran[0].handler, 2);
  EXPECT_EQ(ran[1].handler, 1);
}

}  // namespace
}  // namespace mars::messages
