// MpiBackend's messages and waiting.
#include <sched.h>

#include <algorithm>
#include <chrono>
#include <climits>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <utility>

#include "hal/messages/message_types.h"
#include "hal/mpi/announcement.h"
#include "hal/mpi/mpi_backend.h"
#include "hal/mpi/mpi_call.h"
#include "hal/mpi/patience.h"

namespace mars::mpi {
namespace {

// Every few calls look at as many of the copies on their way: all are seen soon, at a small price each.
constexpr std::size_t kReclaimAtOnce = 4;

constexpr std::chrono::microseconds kLongestBlindSleep{1000};

// Bytes from which on a message may not be gone before it is received.
constexpr std::size_t kLong = 4096;

constexpr std::size_t kCopiedAtOnce = 32 * 1024;

std::size_t length_of(const MPI_Status& status) {
  int length = 0;
  succeed(MPI_Get_count(&status, MPI_BYTE, &length), "MPI_Get_count");
  return static_cast<std::size_t>(length);
}

}  // namespace

// An MPI need not have tags as large as types are. Internal types have the highest but one that it has;
// others that are too large for it have the highest, and travel behind their message's bytes.
int MpiBackend::tag(int type) const {
  if (type < messages::kFirstInternalType && type <= last_tag_) return type;
  if (messages::type_class(type) == messages::TypeClass::reserved)
    return last_tag_ + 1 + (type - messages::kFirstInternalType);
  return type <= last_tag_ ? type : wide_tag_;
}

int MpiBackend::type(int tag) const {
  return tag <= last_tag_ ? tag : messages::kFirstInternalType + (tag - last_tag_ - 1);
}

// Whether such a message goes as it is.
bool MpiBackend::plain(const void* data, std::size_t length) const {
  return length <= longest_plain_ && !Announcement::read(data, length);
}

// A message that needs no type behind it.
MPI_Request MpiBackend::isend(int to, int type, const void* data, std::size_t length) {
  if (plain(data, length)) return isend_plain(to, tag(type), data, length);
  announce(to, type, length);
  const BytesType bytes(length);
  MPI_Request request = MPI_REQUEST_NULL;
  succeed(MPI_Isend(data, 1, bytes.get(), to, tag(type), all_, &request), "MPI_Isend");
  bells_->ring(to);
  return request;
}

MPI_Request MpiBackend::isend_plain(int to, int tag, const void* data, std::size_t length) {
  MPI_Request request = MPI_REQUEST_NULL;
  succeed(MPI_Isend(data, static_cast<int>(length), MPI_BYTE, to, tag, all_, &request), "MPI_Isend");
  ++sent_to_[to];
  bells_->ring(to);
  return request;
}

void MpiBackend::announce(int to, int type, std::size_t length) {
  const Announcement announcement = Announcement::of(length);
  messages::Message* copy = tag(type) == wide_tag_ ? with_type(type, &announcement, sizeof announcement)
                                                   : pool_.copy({rank_, type, sizeof announcement}, &announcement);
  release_when_sent(isend_plain(to, tag(type), copy->bytes(), copy->envelope.length), copy);
}

// With the bell armed, two looks: see peek. Of what is done already SMPI says nothing.
bool MpiBackend::test(MPI_Request& request, MPI_Status* status) {
  int done = request == MPI_REQUEST_NULL;
  for (int looks = bells_->armed() ? 2 : 1; looks > 0 && done == 0; --looks)
    succeed(MPI_Test(&request, &done, status), "MPI_Test");
  return done != 0;
}

void MpiBackend::wait(MPI_Request& request, MPI_Status* status) {
  if (mpi_waits_well()) return succeed(MPI_Wait(&request, status), "MPI_Wait");
  // In the middle of a message: a derived class's idle is not called.
  for (int turn = 0; !test(request, status); ++turn) MpiBackend::idle(turn, kLongestBlindSleep);
}

// Of a collective call: between looks the rank may send and receive messages.
void MpiBackend::wait_for_others(MPI_Request& request) {
  if (mpi_waits_well() || !while_waiting_) return wait(request);
  for (int turn = 0; !test(request); ++turn) {
    idle(turn, kLongestBlindSleep);
    while_waiting_();
  }
}

void MpiBackend::send(int to, int type, const void* data, std::size_t length) {
  if (tag(type) != wide_tag_ || !plain(data, length))
    return send_copy(to, type, pool_.copy({rank_, type, length}, data));
  messages::Message* copy = with_type(type, data, length);
  release_when_sent(isend_plain(to, wide_tag_, copy->bytes(), copy->envelope.length), copy);
}

void MpiBackend::send_copy(int to, int type, messages::Message* copy) {
  release_when_sent(isend(to, type, copy->bytes(), copy->envelope.length), copy);
}

void MpiBackend::release_when_sent(MPI_Request request, messages::Message* copy) {
  if (test(request)) {
    pool_.release(copy);
  } else {
    pending_.push_back({request, copy});
  }
  reclaim_some();  // afterwards: while the message is on its way
}

// Looks between parts of the copy whether it is needed at all.
std::optional<messages::Ticket> MpiBackend::send_or_start(int to, int type, const void* data, std::size_t length) {
  if (length < kLong || !bells_->reaches(to) || tag(type) == wide_tag_) {
    send(to, type, data, length);
    return std::nullopt;
  }
  messages::Message* copy = pool_.acquire({rank_, type, length});
  for (std::size_t done = 0; done < length; done += kCopiedAtOnce) {
    if (bells_->claim(to, type)) {
      pool_.release(copy);
      return start_send(to, type, data, length);
    }
    std::memcpy(copy->bytes() + done, static_cast<const std::byte*>(data) + done,
                std::min(kCopiedAtOnce, length - done));
  }
  send_copy(to, type, copy);
  return std::nullopt;
}

messages::Message* MpiBackend::with_type(std::int32_t type, const void* data, std::size_t length) {
  messages::Message* message = pool_.acquire({rank_, type, length + sizeof type});
  if (length > 0) std::memcpy(message->bytes(), data, length);
  std::memcpy(message->bytes() + length, &type, sizeof type);
  return message;
}

bool MpiBackend::nothing_under_way() {
  return pending_.empty() &&
         std::all_of(tickets_.begin(), tickets_.end(), [this](Started& started) { return test(started.request); });
}

void MpiBackend::reclaim_some() {
  for (std::size_t looks = std::min(kReclaimAtOnce, pending_.size()); looks > 0; --looks) {
    if (next_pending_ >= pending_.size()) next_pending_ = 0;
    if (!test(pending_[next_pending_].request)) {
      ++next_pending_;
      continue;
    }
    pool_.release(pending_[next_pending_].message);
    pending_[next_pending_] = pending_.back();
    pending_.pop_back();
    if (pending_.empty()) return;
  }
}

messages::Ticket MpiBackend::start_send(int to, int type, const void* data, std::size_t length) {
  if (tag(type) != wide_tag_ || !plain(data, length)) return ticket_for(isend(to, type, data, length));
  send(to, type, data, length);
  return ticket_for(MPI_REQUEST_NULL);
}

messages::Ticket MpiBackend::ticket_for(MPI_Request request, int sender) {
  if (free_tickets_.empty()) {
    free_tickets_.push_back(static_cast<messages::Ticket>(tickets_.size()));
    tickets_.push_back({MPI_REQUEST_NULL});
    free_tickets_.reserve(tickets_.size());
  }
  const messages::Ticket ticket = free_tickets_.back();
  free_tickets_.pop_back();
  tickets_[ticket] = {request, sender};
  return ticket;
}

bool MpiBackend::sent(messages::Ticket ticket) {
  Started& started = tickets_[ticket];
  if (!test(started.request)) return false;
  if (started.sender >= 0) bells_->ring(started.sender);
  free_tickets_.push_back(ticket);
  return true;
}

std::optional<messages::Envelope> MpiBackend::peek() {
  reclaim_some();
  if (peeked_) return peeked_;
  int arrived = 0;
  MPI_Status status;
  // Open MPI's first look may only fetch what has come, and the second one sees it: a rank that slept after the first
  // would not be rung again.
  for (int looks = bells_->armed() ? 2 : 1; looks > 0 && arrived == 0; --looks)
    succeed(MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, all_, &arrived, &status), "MPI_Iprobe");
  if (arrived == 0) return std::nullopt;
  bells_->await(Bells::kNothing);
  peeked_ = messages::Envelope{status.MPI_SOURCE, type(status.MPI_TAG), length_of(status)};
  if (status.MPI_TAG == wide_tag_)
    peeked_ = open_wide(*peeked_);
  else if (peeked_->length == sizeof(Announcement))
    open(*peeked_, status.MPI_TAG);
  if (opened_ != nullptr) {
    if (const auto length = Announcement::read(opened_->bytes(), peeked_->length)) {
      peeked_->length = *length;
      announced_ = true;
      pool_.release(std::exchange(opened_, nullptr));
    }
  }
  return peeked_;
}

void MpiBackend::open(const messages::Envelope& whole, int tag) {
  opened_ = pool_.acquire(whole);
  receive(opened_->bytes(), whole, tag);
}

messages::Envelope MpiBackend::open_wide(const messages::Envelope& whole) {
  open(whole, wide_tag_);
  std::int32_t type = 0;
  const std::size_t length = whole.length - sizeof type;
  std::memcpy(&type, opened_->bytes() + length, sizeof type);
  return {whole.from, type, length};
}

MPI_Request MpiBackend::start_receive(void* buffer, const messages::Envelope& envelope, int tag) {
  MPI_Request request = MPI_REQUEST_NULL;
  succeed(MPI_Irecv(buffer, static_cast<int>(envelope.length), MPI_BYTE, envelope.from, tag, all_, &request),
          "MPI_Irecv");
  return request;
}

// The next of its tag, for its sender has sent it right behind the announcement, and nobody has looked since.
MPI_Request MpiBackend::start_body(void* buffer, const messages::Envelope& envelope) {
  const BytesType bytes(envelope.length);
  MPI_Request request = MPI_REQUEST_NULL;
  succeed(MPI_Irecv(buffer, 1, bytes.get(), envelope.from, tag(envelope.type), all_, &request), "MPI_Irecv");
  return request;
}

MPI_Request MpiBackend::start_peeked(void* buffer) {
  return std::exchange(announced_, false) ? start_body(buffer, *peeked_)
                                          : start_receive(buffer, *peeked_, tag(peeked_->type));
}

void MpiBackend::receive(void* buffer, const messages::Envelope& envelope, int tag) {
  MPI_Request request = start_receive(buffer, envelope, tag);
  wait(request);
  // Its sender may be waiting for just that; of a short one it does not.
  if (envelope.length >= kLong) bells_->ring(envelope.from);
}

void MpiBackend::take(void* buffer) {
  if (opened_ == nullptr) {
    MPI_Request request = start_peeked(buffer);
    wait(request);
    if (peeked_->length >= kLong) bells_->ring(peeked_->from);  // as in receive
  } else {
    if (peeked_->length > 0) std::memcpy(buffer, opened_->bytes(), peeked_->length);
    pool_.release(opened_);
    opened_ = nullptr;
  }
  peeked_.reset();
  ++taken_;
}

// Short ones are here as soon as they are seen.
std::optional<messages::Ticket> MpiBackend::start_take(void* buffer) {
  if (opened_ != nullptr || peeked_->length < kLong || mpi_waits_well()) {
    take(buffer);
    return std::nullopt;
  }
  const int from = peeked_->from;
  const MPI_Request request = start_peeked(buffer);
  peeked_.reset();
  ++taken_;
  return ticket_for(request, from);
}

// A short one is received without a look before. Senders of a long one learn that it need not be copied.
bool MpiBackend::receive_soon(int type, void* buffer, std::size_t capacity, messages::Envelope& came) {
  if (peeked_ || tag(type) == wide_tag_ || mpi_waits_well()) return false;
  if (capacity >= kLong || caught_.bytes() == nullptr) {
    if (!peek()) bells_->await(type);
    return false;
  }
  MPI_Status status;
  if (!catch_soon(type, status)) return false;
  const std::size_t length = length_of(status);
  if (const auto announced = Announcement::read(caught_.bytes(), length)) {
    peeked_ = messages::Envelope{status.MPI_SOURCE, type, *announced};
    announced_ = true;
    return false;
  }
  if (length > capacity) {
    peeked_ = messages::Envelope{status.MPI_SOURCE, type, length};
    opened_ = pool_.copy(*peeked_, caught_.bytes());
    caught_.trim(length);
    if (length >= kLong) bells_->ring(peeked_->from);  // as in receive
    return false;
  }
  if (length > 0) std::memcpy(buffer, caught_.bytes(), length);
  ++taken_;
  came.from = status.MPI_SOURCE;
  came.type = type;
  came.length = length;
  return true;
}

bool MpiBackend::catch_soon(int type, MPI_Status& status) {
  MPI_Request request = MPI_REQUEST_NULL;
  succeed(MPI_Irecv(caught_.bytes(), INT_MAX, MPI_BYTE, MPI_ANY_SOURCE, tag(type), all_, &request), "MPI_Irecv");
  const int at_once = turns_at_once(oversubscribed_);
  int done = 0;
  for (int turn = 0; turn < at_once && done == 0; ++turn) succeed(MPI_Test(&request, &done, &status), "MPI_Test");
  if (done != 0) return true;
  for (int turn = at_once; pause_of(turn, oversubscribed_)->count() == 0; ++turn) {
    sched_yield();
    if (test(request, &status)) return true;
  }
  return !give_up(request, status);
}

// False if it came meanwhile.
bool MpiBackend::give_up(MPI_Request& request, MPI_Status& status) {
  int cancelled = 0;
  succeed(MPI_Cancel(&request), "MPI_Cancel");
  wait(request, &status);
  succeed(MPI_Test_cancelled(&status, &cancelled), "MPI_Test_cancelled");
  return cancelled != 0;
}

// Messages from ranks that have no bell here, and progress of sends within MPI, show only to a look. Arms the bell for
// one more look before the first sleep.
void MpiBackend::idle(int turn, std::chrono::microseconds longest) {
  const auto pause = pause_of(turn, oversubscribed_);
  if (!pause) return;
  if (pause->count() == 0)
    sched_yield();
  else if (!bells_->armed())
    bells_->arm();
  else if (*pause < kLongestBlindSleep || (bells_->everyone_has_one() && nothing_under_way()))
    bells_->sleep(std::min(*pause, longest));
  else
    bells_->sleep(std::min(kLongestBlindSleep, longest));
}

}  // namespace mars::mpi
