// Ranks as MPI processes. Messages travel as MPI messages whose tag is their type; receiving is probe, then
// receive of just what was probed, which is safe because one thread a process makes all MPI calls. Waiting
// never spins for long (see idle), also inside of what MPI itself would spin for. Messages that are longer than
// MPI's counts: announcement.h.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <mpi.h>

#include "hal/messages/backend.h"
#include "hal/messages/message_pool.h"
#include "hal/mpi/bells.h"
#include "hal/mpi/overflow.h"

namespace mars::mpi {

class MpiBackend : public messages::Backend {
 public:
  // Collective over `ranks`, among which `host_rank` is the host's; -1: there is none. Nodes get their ids by
  // place.
  explicit MpiBackend(int host_rank, MPI_Comm ranks = MPI_COMM_WORLD);
  // Collective after an orderly finish; after a failure it leaves all to the end of the job.
  ~MpiBackend() override;
  MpiBackend(const MpiBackend&) = delete;
  MpiBackend& operator=(const MpiBackend&) = delete;

  int rank() const override { return rank_; }
  int nodes() const override { return nodes_; }
  void send(int to, int type, const void* data, std::size_t length) override;
  std::optional<messages::Ticket> send_or_start(int to, int type, const void* data, std::size_t length) override;
  messages::Ticket start_send(int to, int type, const void* data, std::size_t length) override;
  bool sent(messages::Ticket ticket) override;
  std::optional<messages::Envelope> peek() override;
  void take(void* buffer) override;
  std::optional<messages::Ticket> start_take(void* buffer) override;
  bool receive_soon(int type, void* buffer, std::size_t capacity, messages::Envelope& came) override;
  std::optional<messages::Ticket> start_reduce(const messages::Reduction& reduction, void* x, std::size_t n) override;
  void idle(int turn, std::chrono::microseconds longest) override;
  double seconds() const override;
  bool has_machine_clock() const override;
  messages::Neighbourhood neighbourhood() override;
  std::shared_ptr<std::byte> share(std::size_t bytes) override;
  messages::Offer offer(std::size_t bytes) override;
  std::shared_ptr<std::byte> attach(int rank, const messages::MemoryName& name, std::size_t bytes) override;
  bool finish() override;
  [[noreturn]] void abort(const std::string& reason) override;

  // Messages that this rank has received.
  std::uint64_t taken() const { return taken_; }

  // Announces messages that are longer than that, and not only those that MPI could not carry otherwise: for
  // tests.
  void announce_beyond(std::size_t length) { longest_plain_ = length; }

 private:
  // A copy on its way.
  struct Pending {
    MPI_Request request;
    messages::Message* message;
  };
  // What a ticket names.
  struct Started {
    MPI_Request request;
    int sender = -1;  // of a message that comes, who is rung when it has; -1: of none
  };
  enum class Ending { not_yet, counting, leaving, ended };

  void look_around();
  void find_out_whether_memory_is_shared();
  bool plain(const void* data, std::size_t length) const;
  MPI_Request isend(int to, int type, const void* data, std::size_t length);
  MPI_Request isend_plain(int to, int tag, const void* data, std::size_t length);
  void announce(int to, int type, std::size_t length);
  messages::Message* with_type(std::int32_t type, const void* data, std::size_t length);
  void open(const messages::Envelope& whole, int tag);
  messages::Envelope open_wide(const messages::Envelope& whole);
  MPI_Request start_receive(void* buffer, const messages::Envelope& envelope, int tag);
  MPI_Request start_body(void* buffer, const messages::Envelope& envelope);
  MPI_Request start_peeked(void* buffer);
  void receive(void* buffer, const messages::Envelope& envelope, int tag);
  void reclaim_some();
  messages::Ticket ticket_for(MPI_Request request, int sender = -1);
  messages::Ticket ticket_of_collective(MPI_Request request);
  void send_copy(int to, int type, messages::Message* copy);
  void release_when_sent(MPI_Request request, messages::Message* copy);
  bool test(MPI_Request& request, MPI_Status* status = MPI_STATUS_IGNORE);
  bool catch_soon(int type, MPI_Status& status);
  bool give_up(MPI_Request& request, MPI_Status& status);
  bool nothing_under_way();
  void wait(MPI_Request& request, MPI_Status* status = MPI_STATUS_IGNORE);
  void wait_for_others(MPI_Request& request);
  std::shared_ptr<std::byte> share_offered(std::size_t bytes, std::string& refusal);

  int tag(int type) const;
  int type(int tag) const;

  MPI_Comm all_;                         // its ranks are ids
  MPI_Comm nodes_only_ = MPI_COMM_NULL;  // null at the host
  MPI_Comm machine_ = MPI_COMM_NULL;     // this machine's nodes; null at the host
  int nodes_ = 0;
  int rank_ = 0;                   // id of this rank
  int last_tag_ = 0;               // the tags up to it are types; those of internal types come after
  int wide_tag_ = 0;               // of messages whose type is larger than last_tag_
  std::size_t longest_plain_ = 0;  // messages that are longer are announced
  bool oversubscribed_ = false;
  std::optional<Bells> bells_;  // as soon as the machine's ranks are known
  std::vector<bool> is_here_;   // by id: a rank of this machine
  messages::Neighbourhood neighbourhood_;

  messages::MessagePool pool_;
  std::vector<Pending> pending_;
  std::size_t next_pending_ = 0;  // to look at
  std::vector<Started> tickets_;  // by ticket
  std::vector<messages::Ticket> free_tickets_;
  std::vector<std::byte> operands_;  // of a reduction under way: SMPI's MPI_IN_PLACE reads a copy that it has freed
  std::optional<messages::Envelope> peeked_;
  messages::Message* opened_ = nullptr;  // the peeked message itself where it had to be received for its type or length
  bool announced_ = false;               // the peeked message's bytes are still to be received
  Overflow caught_;                      // where messages come whose length is not known before

  std::vector<std::int64_t> sent_to_;  // messages, by id
  std::uint64_t taken_ = 0;            // messages
  Ending ending_ = Ending::not_yet;
  MPI_Request ending_request_ = MPI_REQUEST_NULL;
  std::int64_t expected_ = 0;  // messages sent to this rank in all
};

}  // namespace mars::mpi
