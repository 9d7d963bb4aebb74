#include "hal/mpi/announcement.h"

#include <array>
#include <cstring>

#include "hal/mpi/mpi_call.h"

namespace mars::mpi {
namespace {

constexpr char kMark[] = "MARS announces a message of so many bytes:\x01\xfe\x02";
static_assert(sizeof kMark - 1 == sizeof Announcement::mark);

constexpr std::size_t kChunk = std::size_t{1} << 30;

}  // namespace

Announcement Announcement::of(std::size_t length) {
  const std::uint64_t number = length;
  Announcement announcement;
  std::memcpy(announcement.mark, kMark, sizeof announcement.mark);
  std::memcpy(announcement.length, &number, sizeof number);
  return announcement;
}

std::optional<std::size_t> Announcement::read(const void* message) {
  Announcement announcement;
  std::memcpy(&announcement, message, sizeof announcement);
  if (std::memcmp(announcement.mark, kMark, sizeof announcement.mark) != 0) return std::nullopt;
  std::uint64_t number = 0;
  std::memcpy(&number, announcement.length, sizeof number);
  return static_cast<std::size_t>(number);
}

// Chunks, and what is left behind them.
BytesType::BytesType(std::size_t bytes) {
  const auto chunks = static_cast<int>(bytes / kChunk), rest = static_cast<int>(bytes % kChunk);
  MPI_Datatype chunk = MPI_DATATYPE_NULL;
  succeed(MPI_Type_contiguous(static_cast<int>(kChunk), MPI_BYTE, &chunk), "MPI_Type_contiguous");
  const std::array counts = {chunks, rest};
  const std::array<MPI_Aint, 2> places = {0, static_cast<MPI_Aint>(bytes - static_cast<std::size_t>(rest))};
  const std::array types = {chunk, MPI_BYTE};
  succeed(MPI_Type_create_struct(2, counts.data(), places.data(), types.data(), &type_), "MPI_Type_create_struct");
  succeed(MPI_Type_commit(&type_), "MPI_Type_commit");
  succeed(MPI_Type_free(&chunk), "MPI_Type_free");
}

BytesType::~BytesType() { MPI_Type_free(&type_); }

}  // namespace mars::mpi
