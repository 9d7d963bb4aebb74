// What nodes have for machines with contributors goes round them once, on the threads backend: for any machines,
// contributors and sizes of parts each machine with contributors gets all of every part of others, in order; and a node
// that has everything sends it once.
#include "node/group/relay.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <map>
#include <memory>
#include <mutex>
#include <random>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "hal/failure/failure.h"
#include "hal/nx/nx_messages.h"
#include "hal/threads/run_threads.h"
#include "node/group/passes.h"
#include "tests/hal/machines_backend.h"

namespace mars::group {
namespace {

constexpr long kType = 9;
constexpr std::size_t kWord = sizeof(std::uint32_t);
constexpr std::size_t kMostWords = 40'000;  // in a piece: more than wire::kRelayPiece

struct Group {
  int nodes;
  int each;  // on a machine
  std::vector<std::uint8_t> contributes;
  std::vector<std::vector<std::uint32_t>> parts;  // words of each node; the first of a piece says how many follow

  int machine(int node) const { return node / each; }
  bool collects(int machine) const {
    for (int node = machine * each; node < std::min(nodes, (machine + 1) * each); ++node)
      if (contributes[static_cast<std::size_t>(node)] == 1) return true;
    return false;
  }
  int collecting() const {
    int count = 0;
    for (int machine = 0; machine * each < nodes; ++machine) count += collects(machine) ? 1 : 0;
    return count;
  }
};

// A node's part, in pieces of any size.
class Words : public Relayed {
 public:
  explicit Words(const Group& group) : group_(group), rest_(part(static_cast<int>(mynode()))), random_(17) {}

  bool has_part(int node) const override { return !part(node).empty(); }
  bool is_left() const override { return !rest_.empty(); }
  std::size_t fill(std::span<std::byte> piece) override {
    const std::size_t words = std::min(rest_.size(), 1 + random_() % kMostWords);
    std::memcpy(piece.data(), rest_.data(), words * kWord);
    rest_ = rest_.subspan(words);
    return words * kWord;
  }
  void take(int owner, std::span<const std::byte> piece) override {
    std::vector<std::uint32_t>& words = came_[owner];
    words.resize(words.size() + piece.size() / kWord);
    std::memcpy(words.data() + words.size() - piece.size() / kWord, piece.data(), piece.size());
  }

  const std::map<int, std::vector<std::uint32_t>>& came() const { return came_; }

 private:
  std::span<const std::uint32_t> part(int node) const { return group_.parts[static_cast<std::size_t>(node)]; }

  const Group& group_;
  std::span<const std::uint32_t> rest_;
  std::mt19937 random_;
  std::map<int, std::vector<std::uint32_t>> came_;
};

void run(const Group& group, messages::Counts& counts, const std::function<void()>& node_body) {
  messages::Machines machines(group.each);
  threads::run_threads(
      group.nodes, [] {}, node_body,
      [&](messages::Backend& inner) { return std::make_unique<messages::MachinesBackend>(inner, counts, machines); });
}

std::vector<std::int32_t> machines_of(const Group& group) {
  std::vector<std::int32_t> machines;
  for (int node = 0; node < group.nodes; ++node) machines.push_back(group.machine(node) * group.each);
  return machines;
}

// Twice, as buffers are used again.
void expect_all_is_there(const Group& group, messages::Counts& counts) {
  std::mutex mutex;
  run(group, counts, [&] {
    const raster::Neighbours neighbours(machines_of(group), 1);
    Relay relay(kType, kMostWords * kWord, "words");
    std::vector<std::uint8_t> collects(static_cast<std::size_t>(group.nodes));
    for (int time = 0; time < 2; ++time) {
      wait_for_all(neighbours.group());  // as keyframes do
      Words words(group);
      relay.exchange(Collectors(neighbours.group(), group.contributes, neighbours, collects), words);
      const int self = static_cast<int>(mynode()), machine = group.machine(self);
      const std::lock_guard lock(mutex);
      for (int owner = 0; owner < group.nodes; ++owner) {
        const auto& part = group.parts[static_cast<std::size_t>(owner)];
        const bool comes = self % group.each == 0 && group.collects(machine) && group.machine(owner) != machine;
        const auto came = words.came().find(owner);
        EXPECT_EQ(came == words.came().end() ? std::vector<std::uint32_t>() : came->second,
                  comes ? part : std::vector<std::uint32_t>())
            << "of node " << owner << " on node " << self;
      }
    }
  });
}

std::vector<std::uint32_t> some_words(std::size_t count, std::uint32_t first) {
  std::vector<std::uint32_t> words(count);
  std::iota(words.begin(), words.end(), first);
  return words;
}

TEST(Relay, BringsEveryPartToEachMachineWithContributors) {
  std::mt19937 random(5);
  for (const auto& [nodes, each] : {std::pair{1, 1}, {2, 1}, {2, 2}, {3, 1}, {5, 2}, {6, 3}, {7, 1}, {8, 4}, {9, 2}})
    for (int round = 0; round < 4; ++round) {
      SCOPED_TRACE(std::to_string(nodes) + " nodes, " + std::to_string(each) + " a machine, round " +
                   std::to_string(round));
      Group group{nodes, each, {}, {}};
      for (int node = 0; node < nodes; ++node) {
        group.contributes.push_back(round == 0 || random() % 3 == 0 ? 1 : 0);
        const std::size_t words = random() % 3 == 0 ? 0 : random() % (8 * kMostWords);
        group.parts.push_back(some_words(words, static_cast<std::uint32_t>(node) << 24));
      }
      messages::Counts counts;
      expect_all_is_there(group, counts);
    }
}

// However many machines there are, and wherever it is: all others send the same on, but the last.
TEST(Relay, EachMachineSendsNoMoreThanIsThere) {
  constexpr std::size_t kWords = 500'000;
  for (const bool owner_contributes : {true, false}) {
    Group group{6, 1, {1, 1, 1, 1, 1, 1}, std::vector<std::vector<std::uint32_t>>(6)};
    group.contributes[2] = owner_contributes ? 1 : 0;
    group.parts[2] = some_words(kWords, 0);
    messages::Counts counts;
    expect_all_is_there(group, counts);
    constexpr std::uint64_t kTwice = 2 * kWords * kWord;
    std::uint64_t all = 0;
    for (int node = 0; node < group.nodes; ++node) {
      const std::uint64_t bytes = counts.sent({.from = node, .type = kType}).bytes;
      EXPECT_LT(bytes, kTwice + kTwice / 100) << "node " << node;
      EXPECT_GE(bytes, node == 1 ? 0 : kTwice) << "node " << node;
      all += bytes;
    }
    EXPECT_EQ(counts.sent({.from = 1, .type = kType}).bytes, 0u) << "it is the last that gets it";
    EXPECT_LT(all, 5 * kTwice + kTwice / 50);
  }
}

// A node that fails while pieces go round ends the others, wherever it is.
TEST(Relay, ANodeThatFailsEndsAll) {
  const Group group{4, 1, {1, 1, 1, 1}, std::vector<std::vector<std::uint32_t>>(4, some_words(400'000, 0))};
  class Failing : public Words {
   public:
    using Words::Words;
    void take(int owner, std::span<const std::byte> piece) override {
      if (mynode() == 2 && ++pieces_ == 7) throw Failure("it fails", "", "");
      Words::take(owner, piece);
    }

   private:
    int pieces_ = 0;
  };
  messages::Counts counts;
  try {
    run(group, counts, [&] {
      const raster::Neighbours neighbours(machines_of(group), 1);
      Relay relay(kType, kMostWords * kWord, "words");
      std::vector<std::uint8_t> collects(4);
      Failing words(group);
      relay.exchange(Collectors(neighbours.group(), group.contributes, neighbours, collects), words);
    });
    ADD_FAILURE() << "the others go on";
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.problem, "it fails");
  }
}

// A message of a node that has no part, or of no owner, or too short for its head, ends the job.
TEST(Relay, RefusesWhatMakesNoSense) {
  struct Head {
    std::int32_t owner;
    std::uint32_t last;
  };
  const Group group{2, 1, {1, 1}, {{}, some_words(10, 0)}};
  for (const Head& head : {Head{0, 1}, {7, 0}, {-3, 1}}) {
    messages::Counts counts;
    EXPECT_THROW(run(group, counts,
                     [&] {
                       const raster::Neighbours neighbours(machines_of(group), 1);
                       Relay relay(kType, kMostWords * kWord, "words");
                       std::vector<std::uint8_t> collects(2);
                       Words words(group);
                       if (mynode() == 1) return csend(kType, &head, sizeof head, 0, 0);
                       relay.exchange(Collectors(neighbours.group(), group.contributes, neighbours, collects), words);
                     }),
                 Failure)
        << head.owner;
  }
}

}  // namespace
}  // namespace mars::group
