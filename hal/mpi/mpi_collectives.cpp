// MPI's own collectives, in the form that does not wait: their blocking forms spin.
#include <algorithm>
#include <climits>
#include <cstddef>
#include <optional>
#include <span>
#include <string>

#include "hal/failure/failure.h"
#include "hal/mpi/mpi_backend.h"
#include "hal/mpi/mpi_call.h"
#include "hal/mpi/patience.h"

namespace mars::mpi {
namespace {

MPI_Datatype datatype(messages::Reduction::Element element) {
  switch (element) {
    case messages::Reduction::Element::real64: return MPI_DOUBLE;
    case messages::Reduction::Element::real32: return MPI_FLOAT;
    case messages::Reduction::Element::whole: return MPI_LONG;
  }
  return MPI_DATATYPE_NULL;
}

MPI_Op operation(messages::Reduction::Rule rule) {
  switch (rule) {
    case messages::Reduction::Rule::sum: return MPI_SUM;
    case messages::Reduction::Rule::product: return MPI_PROD;
    case messages::Reduction::Rule::high: return MPI_MAX;
    case messages::Reduction::Rule::low: return MPI_MIN;
    case messages::Reduction::Rule::bit_and: return MPI_BAND;
    case messages::Reduction::Rule::bit_or: return MPI_BOR;
    case messages::Reduction::Rule::bit_xor: return MPI_BXOR;
  }
  return MPI_OP_NULL;
}

bool fits(std::span<const messages::ByteRange> ranges) {
  return std::all_of(ranges.begin(), ranges.end(),
                     [](const messages::ByteRange& each) { return each.offset + each.length <= INT_MAX; });
}

}  // namespace

// Where MPI waits well it is done on return.
messages::Ticket MpiBackend::ticket_of_collective(MPI_Request request) {
  if (mpi_waits_well()) succeed(MPI_Wait(&request, MPI_STATUS_IGNORE), "MPI_Wait");
  return ticket_for(request);
}

std::optional<messages::Ticket> MpiBackend::start_reduce(const messages::Reduction& reduction, void* x, std::size_t n) {
  if (n > INT_MAX) return std::nullopt;
  const MPI_Datatype type = datatype(reduction.element);
  int bytes = 0;
  succeed(MPI_Type_size(type, &bytes), "MPI_Type_size");
  const auto* values = static_cast<const std::byte*>(x);
  operands_.assign(values, values + n * static_cast<std::size_t>(bytes));
  MPI_Request request = MPI_REQUEST_NULL;
  succeed(
      MPI_Iallreduce(operands_.data(), x, static_cast<int>(n), type, operation(reduction.rule), nodes_only_, &request),
      "MPI_Iallreduce");
  return ticket_of_collective(request);
}

std::optional<messages::Ticket> MpiBackend::start_all_to_all(const void* out, std::span<const messages::ByteRange> to,
                                                             void* in, std::span<const messages::ByteRange> from) {
  if (!fits(to) || !fits(from))
    throw Failure("an exchange of more bytes than MPI carries at once", "node " + std::to_string(rank_),
                  "exchange less than 2 GB at once, or set MARS_NX_COLLECTIVES to cube");
  counts_.clear();
  for (const std::span<const messages::ByteRange> ranges : {to, from}) {
    for (const messages::ByteRange& each : ranges) counts_.push_back(static_cast<int>(each.length));
    for (const messages::ByteRange& each : ranges) counts_.push_back(static_cast<int>(each.offset));
  }
  const int* counts = counts_.data();
  const std::size_t n = to.size();
  MPI_Request request = MPI_REQUEST_NULL;
  succeed(MPI_Ialltoallv(out, counts, counts + n, MPI_BYTE, in, counts + 2 * n, counts + 3 * n, MPI_BYTE, nodes_only_,
                         &request),
          "MPI_Ialltoallv");
  return ticket_of_collective(request);
}

}  // namespace mars::mpi
