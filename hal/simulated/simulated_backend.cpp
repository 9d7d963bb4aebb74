#include "hal/simulated/simulated_backend.h"

#include <algorithm>
#include <utility>

#include "hal/failure/failure.h"

namespace mars::simulated {
namespace {

// As the contract says: who gives so much has nothing to do before a message comes.
constexpr std::chrono::microseconds kPatient{5000};

constexpr messages::Ticket kSent = 0;  // of a message that is sent at once

}  // namespace

void SimulatedBackend::send(int to, int type, const void* data, std::size_t length) {
  world_.send(rank_, to, type, data, length);
}

messages::Ticket SimulatedBackend::start_send(int to, int type, const void* data, std::size_t length) {
  send(to, type, data, length);
  return kSent;
}

std::optional<messages::Ticket> SimulatedBackend::start_take(void* buffer) {
  const World::Taken taken = world_.begin_take(rank_, buffer);
  if (taken.there <= seconds()) {
    world_.end_take(rank_, taken);
    return std::nullopt;
  }
  world_.set_alarm(rank_, taken.there);
  auto place = std::ranges::find(coming_, World::kNever, &World::Taken::there);
  if (place == coming_.end()) place = coming_.insert(place, World::Taken{});
  *place = taken;
  return kSent + 1 + static_cast<messages::Ticket>(place - coming_.begin());
}

bool SimulatedBackend::sent(messages::Ticket ticket) {
  if (ticket == kSent) return true;
  World::Taken& message = coming_[static_cast<std::size_t>(ticket - kSent - 1)];
  if (message.there > seconds()) return false;
  message.there = World::kNever;
  world_.end_take(rank_, message);
  return true;
}

void SimulatedBackend::idle(int, std::chrono::microseconds longest) {
  const double seconds = std::chrono::duration<double>(longest).count();
  world_.wait(rank_, finishing_ || longest >= kPatient ? World::kNever : seconds);
}

void SimulatedBackend::charge(int kind, std::uint64_t units) {
  const auto& costs = world_.machine().work;
  const auto place = static_cast<std::size_t>(kind);
  if (place < costs.size() && units > 0) world_.work(rank_, costs[place] * static_cast<double>(units));
}

messages::Neighbourhood SimulatedBackend::neighbourhood() {
  check(rank_ != host(), "the host is not one of a machine's nodes");
  const int computer = world_.computer_of(rank_);
  const int first = computer * world_.machine().nodes;
  return {first, rank_ - first, world_.nodes_on(computer), rank_, true};
}

std::shared_ptr<std::byte> SimulatedBackend::share(std::size_t bytes) {
  check(rank_ != host(), "the host takes no part in shared memory");
  return world_.share(rank_, shared_++, bytes);
}

std::shared_ptr<std::byte> SimulatedBackend::replica(std::uint64_t key, std::size_t bytes) {
  return world_.replica(key, bytes);
}

messages::Offer SimulatedBackend::offer(std::size_t bytes) { return world_.offer(rank_, bytes); }

std::shared_ptr<std::byte> SimulatedBackend::attach(int rank, const messages::MemoryName& name, std::size_t bytes) {
  const bool named = name.words[1] == static_cast<std::uint64_t>(rank) && name.words[2] == bytes;
  return named ? world_.attach(rank_, rank, name) : nullptr;
}

bool SimulatedBackend::finish() {
  world_.check_running();
  if (!std::exchange(finishing_, true)) world_.finish_one();
  return world_.finished() && !peek();
}

void SimulatedBackend::abort(const std::string& reason) {
  const Failure failure(reason, "", "");
  world_.stop(std::make_exception_ptr(failure));
  throw failure;
}

}  // namespace mars::simulated
