#include "hal/threads/threads_backend.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "hal/failure/failure.h"
#include "hal/messages/pages.h"

namespace mars::threads {
namespace {

// So that a false name is known as one, it says all of what it names.
messages::MemoryName name_of(std::uint64_t number, int rank, std::size_t bytes, const std::byte* block) {
  return {{number, static_cast<std::uint64_t>(rank), bytes, reinterpret_cast<std::uintptr_t>(block)}};
}

}  // namespace

int ThreadsBackend::nodes() const { return world_.nodes(); }

void ThreadsBackend::send(int to, int type, const void* data, std::size_t length) {
  world_.check_running();
  {
    const std::lock_guard lock(mutex_);
    while (!returned_.empty()) pool_.release(returned_.pop());
  }
  world_.rank(to).deliver(pool_.copy({rank_, type, length}, data));
}

// A copy is needed here too: were the sender stopped, its buffer would be gone under the receiver's hands.
messages::Ticket ThreadsBackend::start_send(int to, int type, const void* data, std::size_t length) {
  send(to, type, data, length);
  return 0;
}

std::optional<messages::Envelope> ThreadsBackend::peek() {
  world_.check_running();
  if (inbox_.empty()) {
    const std::lock_guard lock(mutex_);
    inbox_.append(arrived_);
  }
  if (inbox_.empty()) return std::nullopt;
  return inbox_.front()->envelope;
}

void ThreadsBackend::take(void* buffer) {
  messages::Message* message = inbox_.pop();
  if (message->envelope.length > 0) std::memcpy(buffer, message->bytes(), message->envelope.length);
  world_.rank(message->envelope.from).give_back(message);
}

void ThreadsBackend::idle(int turn, std::chrono::microseconds longest) {
  world_.check_running();
  const std::chrono::microseconds pause(20 << std::min(turn, 10));
  std::unique_lock lock(mutex_);
  news_.wait_for(lock, std::min(pause, longest), [this] { return has_news_; });
  has_news_ = false;
}

void ThreadsBackend::deliver(messages::Message* message) {
  {
    const std::lock_guard lock(mutex_);
    arrived_.push(message);
    has_news_ = true;
  }
  news_.notify_one();
}

void ThreadsBackend::give_back(messages::Message* message) {
  const std::lock_guard lock(mutex_);
  returned_.push(message);
}

void ThreadsBackend::wake() {
  {
    const std::lock_guard lock(mutex_);
    has_news_ = true;
  }
  news_.notify_one();
}

messages::Neighbourhood ThreadsBackend::neighbourhood() {
  check(rank_ != host(), "the host is not one of a machine's nodes");
  return {0, rank_, nodes(), rank_, false};
}

std::shared_ptr<std::byte> ThreadsBackend::share(std::size_t bytes) {
  check(rank_ != host(), "the host takes no part in shared memory");
  return world_.share(shared_++, bytes);
}

messages::Offer ThreadsBackend::offer(std::size_t bytes) { return world_.offer(rank_, bytes); }

std::shared_ptr<std::byte> ThreadsBackend::attach(int rank, const messages::MemoryName& name, std::size_t bytes) {
  const auto [number, offerer, size, address] = name.words;
  if (offerer != static_cast<std::uint64_t>(rank) || size != bytes) return nullptr;
  return world_.attach(name);
}

bool ThreadsBackend::finish() {
  world_.check_running();
  if (!std::exchange(finishing_, true)) world_.finish_one();
  return world_.finished() && !peek();
}

void ThreadsBackend::abort(const std::string& reason) {
  const Failure failure(reason, "", "");
  world_.stop(std::make_exception_ptr(failure));
  throw failure;
}

ThreadsWorld::ThreadsWorld(int nodes) {
  check(nodes >= 1, "there is at least one node");
  for (int rank = 0; rank <= nodes; ++rank) ranks_.push_back(std::make_unique<ThreadsBackend>(*this, rank));
}

void ThreadsWorld::stop(std::exception_ptr reason) {
  {
    const std::lock_guard lock(mutex_);
    if (failure_ == nullptr) failure_ = std::move(reason);
  }
  stopped_ = true;
  wake_all();
}

std::exception_ptr ThreadsWorld::failure() const {
  const std::lock_guard lock(mutex_);
  return failure_;
}

void ThreadsWorld::check_running() const {
  if (stopped_) std::rethrow_exception(failure());
}

void ThreadsWorld::finish_one() {
  ++finished_;
  if (finished()) wake_all();
}

void ThreadsWorld::wake_all() {
  for (const auto& rank : ranks_) rank->wake();
}

std::shared_ptr<std::byte> ThreadsWorld::share(int index, std::size_t bytes) {
  const std::lock_guard lock(mutex_);
  if (index == static_cast<int>(blocks_.size())) blocks_.push_back({messages::map_pages(bytes), bytes, 0});
  Block& block = blocks_[index];
  check(block.size == bytes, "all nodes of a machine share the same number of bytes");
  if (block.bytes == nullptr) throw messages::too_much_to_share(bytes, "");
  std::shared_ptr<std::byte> mine = block.bytes;
  if (++block.holders == nodes()) block.bytes.reset();
  return mine;
}

messages::Offer ThreadsWorld::offer(int rank, std::size_t bytes) {
  std::shared_ptr<std::byte> block = messages::map_pages(bytes);
  if (block == nullptr) return {};
  // A handle of its rank's own: the bytes may outlive it at others, but nobody attaches them any more.
  std::shared_ptr<std::byte> handle(block.get(), [block](std::byte*) mutable { block.reset(); });
  const std::lock_guard lock(mutex_);
  std::erase_if(offered_, [](const Offered& old) { return old.offer.expired(); });
  const messages::MemoryName name = name_of(offers_++, rank, bytes, block.get());
  offered_.push_back({name, handle, block});
  return {name, handle};
}

std::shared_ptr<std::byte> ThreadsWorld::attach(const messages::MemoryName& name) {
  const std::lock_guard lock(mutex_);
  for (const Offered& offered : offered_)
    if (offered.name == name && !offered.offer.expired()) return offered.bytes.lock();
  return nullptr;
}

}  // namespace mars::threads
