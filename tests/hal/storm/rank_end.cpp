// The end of a storm's round at one rank: until everything that was sent to it is accounted for.
#include <algorithm>

#include "hal/nx/nx_messages.h"
#include "tests/hal/storm/handlers.h"
#include "tests/hal/storm/rank.h"

namespace mars::storm {

void Rank::finish() {
  send_to_all(kSentAll);
  await_all_sent();
  masked_ = 0;
  masktrap(0);
  await_the_owed();
  cancel_all();
  drain();
  release_handlers();
  while (!sending_.empty()) wait_for_a_send();
  while (std::find(sending_by_.begin(), sending_by_.end(), true) != sending_by_.end()) {
    check_time();
    flick();
  }
  ledger_.close();
  send_to_all(kGotAll);
  for (; !got_all_.empty(); got_all_.pop_back()) msgwait(got_all_.back());
}

void Rank::send_to_all(std::int32_t type) {
  for (int rank = 0; rank <= nodes_; ++rank)
    if (rank != me_) csend(type, nullptr, 0, rank, 0);
}

// Goes on with all but sending until every rank is done with that: then all that is sent to this one has come.
void Rank::await_all_sent() {
  while (!sent_all_.empty()) {
    check_time();
    if (msgdone(sent_all_.back()) == 1)
      sent_all_.pop_back();
    else if (maybe(3))
      flick();
    else if (maybe(2))
      ask();
    else
      probe_and_receive();
    collect_fired();
  }
}

// Half of the ranks in crecv, where nothing else could take what comes; the others by looking again and again.
void Rank::await_the_owed() {
  if (maybe(2)) cancel_all();
  while (ledger_.owed() > 0) {
    check_time();
    collect_fired();
    if (receives_.empty() && ledger_.owed() > 0) {
      receive_now(-1, capacity_for(-1), nullptr);
      continue;
    }
    for (std::size_t asked = receives_.size(); asked > 0; --asked) ask();
    probe_and_receive();
  }
}

void Rank::cancel_all() {
  for (auto at = receives_.begin(); at != receives_.end();) {
    if (at->mid < 0) {
      ++at;
      continue;
    }
    if (!ask(at)) {
      msgcancel(at->mid);
      receives_.erase(at);
    }
    at = receives_.begin();  // others may be gone with it
  }
}

void Rank::drain() {
  const Masked masked(*this);
  while (iprobe(-1) == 1) receive_now(-1, static_cast<std::size_t>(infocount()), nullptr);
}

// An hrecv stays until its message comes: so each gets one from this rank.
void Rank::release_handlers() {
  for (collect_fired(); !receives_.empty(); collect_fired()) {
    const std::int32_t type = type_for(receives_.front().taker.typesel);
    const Send filler{me_, type, 8, 0x80000000u + fillers_++};
    ledger_.add(me_, filler);
    const Bytes bytes = contents(seed_, me_, filler.number, filler.length);
    csend(type, bytes.data(), 8, me_, 0);
    while (std::none_of(receives_.begin(), receives_.end(), [](const Receive& one) { return one.fired; })) {
      check_time();
      run_handlers();
    }
  }
}

}  // namespace mars::storm
