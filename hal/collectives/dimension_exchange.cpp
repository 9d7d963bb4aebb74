#include "hal/collectives/dimension_exchange.h"

#include <bit>

#include "hal/failure/failure.h"
#include "hal/messages/arguments.h"
#include "hal/messages/call_failure.h"
#include "hal/messages/process.h"

namespace mars::collectives {
namespace {

// From here on a copy costs more than what it takes to do without one.
constexpr std::size_t kLong = 4096;

constexpr char kSpoilt = 0;

}  // namespace

DimensionExchange::DimensionExchange(const char* call, const Group& group)
    : call_(call), process_(messages::process()), group_(group) {
  const messages::Backend& backend = process_.backend();
  const int rank = backend.rank();
  if (rank == backend.host())
    process_.fail(call, messages::kNoSuchNode, "the host takes no part in collectives", "call it on nodes only");
  check(0 <= group.first && 0 < group.count && group.first + group.count <= backend.nodes(),
        "a group lies within the nodes");
  position_ = rank - group.first;
  check(0 <= position_ && position_ < group.count, "a node takes part in its own group");
  corners_ = static_cast<int>(std::bit_floor(static_cast<unsigned>(group.count)));
}

// One byte, or none where one is what belongs there.
std::size_t DimensionExchange::spoilt_length(std::size_t bytes) const { return bytes == 1 ? 0 : 1; }

void DimensionExchange::send(int to, const void* data, std::size_t bytes) {
  if (spoilt())
    process_.send_internal(group_.first + to, &kSpoilt, spoilt_length(bytes));
  else
    process_.send_internal(group_.first + to, data, bytes);
}

void DimensionExchange::receive(int from, void* data, std::size_t bytes) {
  check_came(from, process_.receive_internal(call_, group_.first + from, data, bytes), bytes);
}

void DimensionExchange::swap_with(int partner, const void* out, std::size_t out_bytes, void* in, std::size_t in_bytes) {
  if (spoilt() || out_bytes < kLong) {
    send(partner, out, out_bytes);
    receive(partner, in, in_bytes);
  } else {
    const messages::Ticket ticket = process_.start_internal(group_.first + partner, out, out_bytes);
    receive(partner, in, in_bytes);
    process_.wait_sent(ticket);
  }
}

void DimensionExchange::check_came(int from, std::size_t came, std::size_t bytes) {
  if (came == bytes) return;
  const char* remedy = "all nodes call the same collectives in the same order with the same lengths";
  if (came == spoilt_length(bytes))
    return spoil(messages::kBadLength, std::string("another node's ") + call_ + " failed", remedy);
  spoil(messages::kBadLength,
        messages::rank_name(group_.first + from, process_.backend().host()) + " gave " + messages::bytes_text(came) +
            " where " + messages::bytes_text(bytes) + " belong",
        remedy);
}

void DimensionExchange::spoil(int code, const std::string& what, const std::string& remedy) {
  if (!fault_) fault_ = Fault{code, what, remedy};
}

void DimensionExchange::fail() const { process_.fail(call_, fault_->code, fault_->what, fault_->remedy); }

}  // namespace mars::collectives
