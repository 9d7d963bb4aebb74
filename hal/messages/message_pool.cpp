#include "hal/messages/message_pool.h"

#include <algorithm>
#include <bit>
#include <cstring>

namespace mars::messages {
namespace {

constexpr int kSmallestClass = 6;  // 64 bytes: a cache line
constexpr int kLastReady = 20;     // 1 MiB: the classes up to it are there from the start

// How many messages a class grows by. What is never used is never touched, and so takes no memory.
constexpr std::size_t kSlab = 32 * 1024;
constexpr std::size_t kReady = 8;

int class_for(std::size_t length) { return std::max<int>(kSmallestClass, std::bit_width(length - (length > 0))); }

}  // namespace

void MessageList::push(Message* message) {
  message->next = nullptr;
  (last_ == nullptr ? first_ : last_->next) = message;
  last_ = message;
}

void MessageList::insert(Message* message) {
  if (last_ == nullptr || last_->arrival < message->arrival) return push(message);
  Message** link = &first_;
  while ((*link)->arrival < message->arrival) link = &(*link)->next;
  message->next = *link;
  *link = message;
}

Message* MessageList::pop() {
  Message* message = first_;
  first_ = message->next;
  if (first_ == nullptr) last_ = nullptr;
  return message;
}

void MessageList::append(MessageList& other) {
  if (other.empty()) return;
  (last_ == nullptr ? first_ : last_->next) = other.first_;
  last_ = other.last_;
  other = MessageList();
}

void MessageList::remove(Message* message) {
  Message* before = nullptr;
  for (Message* at = first_; at != message; at = at->next) before = at;
  (before == nullptr ? first_ : before->next) = message->next;
  if (last_ == message) last_ = before;
}

MessagePool::MessagePool() {
  for (int size_class = kSmallestClass; size_class <= kLastReady; ++size_class) grow(size_class);
}

Message* MessagePool::acquire(const Envelope& envelope) {
  const int size_class = class_for(envelope.length);
  if (free_[size_class] == nullptr) grow(size_class);
  Message* message = free_[size_class];
  free_[size_class] = message->next;
  // One by one: read as a whole, what was just written in parts would have to be waited for.
  message->envelope.from = envelope.from;
  message->envelope.type = envelope.type;
  message->envelope.length = envelope.length;
  return message;
}

Message* MessagePool::copy(const Envelope& envelope, const void* data) {
  Message* message = acquire(envelope);
  if (envelope.length > 0) std::memcpy(message->bytes(), data, envelope.length);
  return message;
}

void MessagePool::release(Message* message) {
  message->next = free_[message->size_class];
  free_[message->size_class] = message;
}

void MessagePool::grow(int size_class) {
  const std::size_t size = sizeof(Message) + (std::size_t{1} << size_class);
  const std::size_t count = std::max(size_class <= kLastReady ? kReady : 1, kSlab / size);
  slabs_.reserve(slabs_.size() + 1);
  slabs_.emplace_back(static_cast<std::byte*>(::operator new(count* size, std::align_val_t(alignof(Message)))));
  for (std::size_t i = 0; i < count; ++i) {
    Message* message = new (slabs_.back().get() + i * size) Message;
    message->size_class = size_class;
    release(message);
  }
}

}  // namespace mars::messages
