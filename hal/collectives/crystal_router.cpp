#include "hal/collectives/crystal_router.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <utility>

#include "hal/collectives/dimension_exchange.h"
#include "hal/collectives/reduction.h"
#include "hal/failure/failure.h"
#include "hal/messages/process.h"

namespace mars::collectives {
namespace {

constexpr char kCall[] = "an exchange of parcels";

// In smaller groups all go directly; as do loads so long that forwarding costs more than messages.
constexpr int kFewNodes = 64;
constexpr std::size_t kLongLoad = 64;  // bytes of a node, for each node of the group

}  // namespace

Route route_for(int nodes, std::size_t bytes) {
  const bool long_load = bytes > kLongLoad * static_cast<std::size_t>(nodes);
  return nodes < kFewNodes || long_load ? Route::direct : Route::crystal;
}

struct CrystalRouter::Head {
  int from;  // id
  int to;    // id
  std::size_t bytes;

  // In a load; the next head is aligned.
  std::size_t whole() const { return sizeof(Head) + (bytes + alignof(Head) - 1) / alignof(Head) * alignof(Head); }
};

template <class Visit>
void CrystalRouter::visit(const Load& load, const Visit& visit) {
  for (std::size_t at = 0; at < load.size;) {
    Head head;
    std::memcpy(&head, load.buffer.data() + at, sizeof head);
    visit(head, load.buffer.data() + at + sizeof head);
    at += head.whole();
  }
}

void CrystalRouter::add(Load& load, const Head& head, const std::byte* bytes) {
  const std::size_t end = load.size + head.whole();
  if (load.buffer.size() < end) load.buffer.resize(std::max(end, 2 * load.buffer.size()));
  std::memcpy(load.buffer.data() + load.size, &head, sizeof head);
  if (head.bytes > 0) std::memcpy(load.buffer.data() + load.size + sizeof head, bytes, head.bytes);
  load.size = end;
}

template <class Wanted>
void CrystalRouter::split(const Load& from, Load& wanted, Load& others, const Wanted& is_wanted) {
  wanted.size = others.size = 0;
  visit(from, [&](const Head& head, const std::byte* bytes) { add(is_wanted(head) ? wanted : others, head, bytes); });
}

void CrystalRouter::send(int to, const Load& load) {
  messages::process().send_internal(to, load.buffer.data(), load.size);
}

messages::Ticket CrystalRouter::start(int to, const Load& load) {
  return messages::process().start_internal(to, load.buffer.data(), load.size);
}

// Behind what is there.
void CrystalRouter::receive(int from, Load& load) {
  load.size += messages::process().receive_internal(kCall, from, load.buffer, load.size);
}

void CrystalRouter::by_crystal(const Group& group) {
  const int me = messages::process().backend().rank() - group.first;
  const int corners = static_cast<int>(std::bit_floor(static_cast<unsigned>(group.count)));
  const auto position = [&](const Head& head) { return head.to - group.first; };
  if (me >= corners) {
    send(group.first + me - corners, held_);
    held_.size = 0;
    return receive(group.first + me - corners, held_);
  }
  const bool folds = me + corners < group.count;
  if (folds) receive(group.first + me + corners, held_);
  for (int bit = 1; bit < corners; bit <<= 1) {
    split(held_, out_, next_, [&](const Head& head) { return ((position(head) & (corners - 1)) & bit) != (me & bit); });
    std::swap(held_, next_);
    const messages::Ticket sending = start(group.first + (me ^ bit), out_);
    receive(group.first + (me ^ bit), held_);
    messages::process().wait_sent(sending);
  }
  if (!folds) return;
  split(held_, out_, next_, [&](const Head& head) { return position(head) != me; });
  std::swap(held_, next_);
  send(group.first + me + corners, out_);
}

void CrystalRouter::directly(const Group& group) {
  const int me = messages::process().backend().rank() - group.first;
  loads_.resize(std::max(loads_.size(), static_cast<std::size_t>(group.count)));
  for (Load& load : loads_) load.size = 0;
  visit(held_, [&](const Head& head, const std::byte* bytes) {
    add(loads_[static_cast<std::size_t>(head.to - group.first)], head, bytes);
  });
  // So that not all send to the same node first.
  tickets_.clear();
  for (int i = 1; i < group.count; ++i) {
    const int to = (me + i) % group.count;
    tickets_.push_back(start(group.first + to, loads_[static_cast<std::size_t>(to)]));
  }
  std::swap(held_, loads_[static_cast<std::size_t>(me)]);
  for (int i = 1; i < group.count; ++i) receive(group.first + (me + group.count - i) % group.count, held_);
  for (const messages::Ticket ticket : tickets_) messages::process().wait_sent(ticket);
}

// First the lengths, then the loads.
bool CrystalRouter::by_network(const Group& group) {
  messages::Backend& backend = messages::process().backend();
  const auto count = static_cast<std::size_t>(group.count);
  if (group != Group{0, backend.nodes()}) return false;
  lengths_.assign(2 * count, 0);
  visit(held_,
        [&](const Head& head, const std::byte*) { lengths_[static_cast<std::size_t>(head.to)] += head.whole(); });
  to_.resize(count);
  from_.resize(count);
  for (std::size_t i = 0; i < count; ++i) to_[i] = from_[i] = {i * sizeof(std::size_t), sizeof(std::size_t)};
  if (!messages::process().all_to_all(lengths_.data(), to_, lengths_.data() + count, from_)) return false;
  std::size_t sent = 0, received = 0;
  for (std::size_t i = 0; i < count; ++i) {
    to_[i] = {std::exchange(sent, sent + lengths_[i]), lengths_[i]};
    from_[i] = {std::exchange(received, received + lengths_[count + i]), lengths_[count + i]};
  }
  // By receiver.
  out_.size = sent;
  if (out_.buffer.size() < sent) out_.buffer.resize(sent);
  std::vector<std::size_t>& places = lengths_;
  for (std::size_t i = 0; i < count; ++i) places[i] = to_[i].offset;
  visit(held_, [&](const Head& head, const std::byte* bytes) {
    std::byte* place = out_.buffer.data() + std::exchange(places[static_cast<std::size_t>(head.to)],
                                                          places[static_cast<std::size_t>(head.to)] + head.whole());
    std::memcpy(place, &head, sizeof head);
    if (head.bytes > 0) std::memcpy(place + sizeof head, bytes, head.bytes);
  });
  if (held_.buffer.size() < received) held_.buffer.resize(received);
  held_.size = received;
  return messages::process().all_to_all(out_.buffer.data(), to_, held_.buffer.data(), from_);
}

std::span<const Parcel> CrystalRouter::sorted() {
  parcels_.clear();
  visit(held_, [&](const Head& head, const std::byte* bytes) { parcels_.push_back({head.from, {bytes, head.bytes}}); });
  std::stable_sort(parcels_.begin(), parcels_.end(), [](const Parcel& a, const Parcel& b) { return a.node < b.node; });
  return parcels_;
}

std::span<const Parcel> CrystalRouter::exchange(const Group& group, std::span<const Parcel> parcels, Route route) {
  DimensionExchange membership(kCall, group);  // fails on a node outside the group
  const int me = messages::process().backend().rank();
  held_.size = 0;
  for (const Parcel& parcel : parcels) {
    check(group.first <= parcel.node && parcel.node < group.first + group.count, "a parcel is for a node of the group");
    add(held_, {me, parcel.node, parcel.bytes.size()}, parcel.bytes.data());
  }
  if (route == Route::automatic && messages::process().collectives() == messages::CollectiveMethod::network)
    route = Route::network;
  if (route == Route::automatic && messages::process().collectives() == messages::CollectiveMethod::cube)
    route = Route::crystal;
  if (route == Route::automatic && group.count >= kFewNodes) {
    auto most = static_cast<unsigned long>(held_.size), work = 0ul;
    reduce(membership, operation<unsigned long, higher>, &most, 1, &work);
    membership.conclude();
    route = route_for(group.count, most);
  }
  if (route == Route::crystal)
    by_crystal(group);
  else if (route != Route::network || !by_network(group))
    directly(group);
  return sorted();
}

}  // namespace mars::collectives
