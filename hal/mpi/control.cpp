#include "hal/mpi/control.h"

#include <utility>

#include "hal/mpi/mpi_call.h"

namespace mars::mpi {

Control::Control(MPI_Comm ranks) : id_(rank_in(ranks)), ended_(static_cast<std::size_t>(size_of(ranks))) {
  succeed(MPI_Comm_dup(ranks, &comm_), "MPI_Comm_dup");
  succeed(MPI_Comm_set_errhandler(comm_, MPI_ERRORS_RETURN), "MPI_Comm_set_errhandler");
}

void Control::send(int to, const Note& note) {
  Sent& sent = sent_.emplace_back(Sent{note, MPI_REQUEST_NULL});
  succeed(MPI_Isend(&sent.note, sizeof sent.note, MPI_BYTE, to, 0, comm_, &sent.request), "MPI_Isend");
}

void Control::look(bool waits, std::uint64_t taken) {
  int there = 1;
  while (!sent_.empty() && there != 0) {
    succeed(MPI_Test(&sent_.front().request, &there, MPI_STATUS_IGNORE), "MPI_Test");
    if (there != 0) sent_.pop_front();
  }
  MPI_Status status;
  while (succeed(MPI_Iprobe(MPI_ANY_SOURCE, 0, comm_, &there, &status), "MPI_Iprobe"), there != 0) {
    Note note{};
    succeed(MPI_Recv(&note, sizeof note, MPI_BYTE, status.MPI_SOURCE, 0, comm_, MPI_STATUS_IGNORE), "MPI_Recv");
    take(status.MPI_SOURCE, note, waits, taken);
  }
  if (watches_ && std::chrono::steady_clock::now() >= next_round_) ask_all();
}

void Control::take(int from, const Note& note, bool waits, std::uint64_t taken) {
  switch (note.what) {
    case Note::ended: ended_[static_cast<std::size_t>(from)] = note.value; break;
    case Note::kill: killed_ = true; break;
    case Note::start: begins_ = note.value != 0; break;
    case Note::ask: send(from, {Note::answer, waits, taken}); break;
    default: answers_ += note.value; taken_ += note.taken;
  }
}

// A rank that computes answers late, and then for an old round: what it has taken since makes the sums
// differ.
void Control::ask_all() {
  next_round_ = std::chrono::steady_clock::now() + kRound;
  const int others = static_cast<int>(ended_.size()) - 1;
  const bool still = answers_ == others && taken_ == taken_before_;
  still_rounds_ = still ? still_rounds_ + 1 : 0;
  taken_before_ = std::exchange(taken_, 0);
  answers_ = 0;
  for (int id = 0; id <= others; ++id)
    if (id != id_) send(id, {Note::ask, 0, 0});
}

}  // namespace mars::mpi
