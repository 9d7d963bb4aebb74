// What is due to one rank in a round, and what has become of it: the model that a storm is held against.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <utility>
#include <vector>

#include "tests/hal/storm/plan.h"

namespace mars::storm {

// The message that a receive or a probe reported.
struct Came {
  int from = 0;
  std::int32_t type = 0;
  std::size_t length = 0;

  bool operator==(const Came&) const = default;
};

// Which receive got a message.
struct Taker {
  long order;  // of posting
  std::int32_t typesel;
};

class Ledger {
 public:
  Ledger(std::uint64_t seed, int me) : seed_(seed), me_(me) {}

  // Adds what the plan of a round brings to this rank.
  void open(int round, int nodes);
  void add(int from, const Send& send);

  // `taker` got this message. Throws unless it is due, is the first that is of its sender and type, and is whole.
  void received(const Taker& taker, const Came& came, const unsigned char* bytes);
  // Throws away what is selected, as flushmsg may have done.
  void flushed(std::int32_t typesel, int node) { flushes_.push_back({typesel, node}); }

  // Messages that must still come.
  std::size_t owed() const { return owed_; }

  // Throws unless all that did not come is accounted for, and of each sender's messages an earlier one went to an
  // earlier receive where the later one's would have taken it.
  void close();

 private:
  struct Due {
    std::uint32_t number;
    std::size_t length;
  };
  struct Taken {
    std::uint32_t number;
    std::int32_t type;
    Taker taker;
  };
  struct Flush {
    std::int32_t typesel;
    int node;
  };

  void lost(int from, std::int32_t type, const Due& due) const;
  void check_order(int from, const std::vector<Taken>& taken) const;

  std::uint64_t seed_;
  int me_;
  std::map<std::pair<int, std::int32_t>, std::deque<Due>> due_;  // by sender and type
  std::map<int, std::vector<Taken>> taken_;                      // by sender
  std::vector<Flush> flushes_;
  std::size_t owed_ = 0;
};

}  // namespace mars::storm
