// MPI's own collectives, in the form that does not wait: their blocking forms spin.
#include <climits>
#include <cstddef>
#include <optional>
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

}  // namespace mars::mpi
