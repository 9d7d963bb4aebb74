// Control messages between the ranks of a job of C programs: a node may begin, a node has ended, a node is to end; and
// whether anything still moves after one has ended with an error.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include <mpi.h>

namespace mars::mpi {

class Control {
 public:
  // Collective over `ranks`, whose ranks there are their ids.
  explicit Control(MPI_Comm ranks);
  Control(const Control&) = delete;
  Control& operator=(const Control&) = delete;

  void report_end(int host, int code) { send(host, {Note::ended, code, 0}); }
  void kill(int id) { send(id, {Note::kill, 0, 0}); }
  // The one word to each node that waits to begin: whether it does.
  void start(int id, bool begins) { send(id, {Note::start, begins, 0}); }

  // Takes in what has come. `waits`: this rank can do nothing before a message comes, and has taken `taken`
  // so far.
  void look(bool waits, std::uint64_t taken);

  bool killed() const { return killed_; }
  // Whether this node begins, once that is known.
  std::optional<bool> begins() const { return begins_; }
  // With which code a node has ended, once it has reported that.
  std::optional<int> ended(int id) const { return ended_[static_cast<std::size_t>(id)]; }

  // From now on asks, with each look, whether anything still moves; true when nothing has for some seconds.
  void watch() { watches_ = true; }
  bool stands_still() const { return still_rounds_ >= kStillRounds; }

 private:
  struct Note {
    enum What : std::int32_t { ended, kill, start, ask, answer };
    std::int32_t what;
    std::int32_t value;  // exit code; whether it begins; whether it waits
    std::uint64_t taken;
  };
  struct Sent {
    Note note;
    MPI_Request request = MPI_REQUEST_NULL;
  };
  static constexpr int kStillRounds = 3;
  static constexpr std::chrono::milliseconds kRound{700};

  void send(int to, const Note& note);
  void take(int from, const Note& note, bool waits, std::uint64_t taken);
  void ask_all();

  MPI_Comm comm_ = MPI_COMM_NULL;
  int id_ = 0;
  std::deque<Sent> sent_;
  bool killed_ = false;
  std::optional<bool> begins_;
  std::vector<std::optional<int>> ended_;

  // Of a rank that watches.
  bool watches_ = false;
  std::chrono::steady_clock::time_point next_round_{};
  int answers_ = 0;          // in this round, of ranks that wait or have ended
  std::uint64_t taken_ = 0;  // by all that answered
  std::uint64_t taken_before_ = 0;
  int still_rounds_ = 0;
};

}  // namespace mars::mpi
