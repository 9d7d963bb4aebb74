// Messages that are longer than MPI's counts, which are ints. Such a message is two of MPI's: under its
// type's tag goes an announcement, which says how long it is; then, under the same tag, the bytes as one
// element of a datatype of that size. So messages of one type stay in order. An announcement is known by its
// length and its mark: a message that happens to look like one is announced itself.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include <mpi.h>

namespace mars::mpi {

// Its length is one that few messages have: each message of that length must be opened.
struct Announcement {
  unsigned char mark[45];
  unsigned char length[sizeof(std::uint64_t)];

  static Announcement of(std::size_t length);
  // The length that a message announces; none: it is a message like others.
  static std::optional<std::size_t> read(const void* message, std::size_t length) {
    return length == sizeof(Announcement) ? read(message) : std::nullopt;
  }

 private:
  static std::optional<std::size_t> read(const void* message);
};

// `bytes` bytes as one element. May be destroyed while a message of this type is under way.
class BytesType {
 public:
  explicit BytesType(std::size_t bytes);
  ~BytesType();
  BytesType(const BytesType&) = delete;
  BytesType& operator=(const BytesType&) = delete;

  MPI_Datatype get() const { return type_; }

 private:
  MPI_Datatype type_ = MPI_DATATYPE_NULL;
};

}  // namespace mars::mpi
