// One rank of a storm: its random program, and what it makes of what it sees.
#pragma once

#include <array>
#include <cstdint>
#include <exception>
#include <utility>
#include <vector>

#include "tests/hal/storm/ledger.h"
#include "tests/hal/storm/plan.h"
#include "tests/hal/storm/receives.h"

namespace mars::storm {

constexpr int kHandlers = 8;  // receives, and as many sends, whose handlers are out at once

class Rank {
 public:
  explicit Rank(std::uint32_t seed);
  ~Rank();
  Rank(const Rank&) = delete;
  Rank& operator=(const Rank&) = delete;

  // One round: all ranks' messages of the plan.
  void run(int round);

  // From handler number `handler`.
  void received(int handler, const Came& came);
  void sent(int handler, const Came& came);

 private:
  using Bytes = std::vector<unsigned char>;

  class Masked {  // holds handlers back while it lives
   public:
    explicit Masked(Rank& rank) : rank_(rank), before_(rank.set_mask(1)) {}
    ~Masked() noexcept(false) {
      if (std::uncaught_exceptions() == 0) rank_.set_mask(before_);
    }

   private:
    Rank& rank_;
    const long before_;
  };

  void start(int round);
  void step();
  void finish();

  // Steps.
  void send_next();
  void post();
  void post_handler();
  void probe_and_receive();
  void ask();
  void cancel();
  void flush();
  void mask();
  void wait_for_a_send();

  // The end of a round.
  void send_to_all(std::int32_t type);
  void await_all_sent();
  void await_the_owed();
  void drain();
  void release_handlers();
  void cancel_all();

  Receive* new_receive();
  void receive_now(std::int32_t typesel, std::size_t capacity, const Came* probed);
  void expect_untouched_by_short(std::int32_t typesel, const Came& probed);
  bool ask(Receives::iterator receive);
  void account(const Taker& taker, const Came& came, const unsigned char* bytes);
  void settle_before(const Taker& taker, const Came& came);
  void collect_fired();
  long set_mask(long state);  // returns what was before
  void run_handlers();
  void check_time() const;
  bool maybe(std::size_t one_in) { return below(random_, one_in) == 0; }

  const std::uint32_t seed_;
  const int me_;
  const int nodes_;
  Random random_;
  Ledger ledger_;

  std::vector<Send> sends_;
  std::size_t next_send_ = 0;
  std::vector<std::pair<long, Bytes>> sending_;  // by id
  std::array<Bytes, kHandlers> handed_;          // bytes of hsends
  std::array<bool, kHandlers> sending_by_ = {};
  std::array<Came, kHandlers> reported_ = {};  // what the hsend's handler must get

  Buffers buffers_;
  Buffers for_now_;
  Receives receives_;
  std::array<Receive*, kHandlers> receiving_by_ = {};
  std::vector<long> sent_all_;  // ids of receives, one for each other rank's word
  std::vector<long> got_all_;
  long order_ = 0;
  std::uint32_t fillers_ = 0;
  long masked_ = 0;
  double deadline_ = 0;
};

}  // namespace mars::storm
