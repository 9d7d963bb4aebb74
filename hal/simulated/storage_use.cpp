#include "hal/simulated/storage_use.h"

#include <algorithm>
#include <cmath>

namespace mars::simulated {
namespace {

// Of a file's bytes, those on server `place` of `servers`, the first of which has the first stripe.
double share(double bytes, double stripe, std::size_t servers, std::size_t place) {
  if (stripe <= 0) return place == 0 ? bytes : 0;
  const double round = stripe * static_cast<double>(servers), rounds = std::floor(bytes / round);
  const double rest = bytes - rounds * round - stripe * static_cast<double>(place);
  return rounds * stripe + std::clamp(rest, 0.0, stripe);
}

}  // namespace

StorageUse::StorageUse(const Storage& storage, const Network& network)
    : storage_(storage), port_byte_(network.byte), servers_(static_cast<std::size_t>(storage.servers)) {}

double StorageUse::write(int computer, double begin, double bytes, double floor) {
  const double opened = opening_.book(begin, storage_.opening, floor) + storage_.opening;
  if (storage_.byte <= 0 && storage_.writer_byte <= 0) return opened;
  const double seconds = bytes * storage_.writer_byte;
  const double sent = writers_[computer].book(opened, seconds, floor) + seconds;
  return std::max({sent, to_servers(opened, bytes, floor), opened + bytes * port_byte_});
}

// When each has its part of a file: the first stripes are on the first servers.
double StorageUse::to_servers(double opened, double bytes, double floor) {
  const auto seconds = [&](std::size_t place) {
    return storage_.byte * share(bytes, storage_.stripe, servers_.size(), place);
  };
  const std::size_t first = first_server(opened, seconds(0));
  double there = opened;
  for (std::size_t place = 0; place < servers_.size() && seconds(place) > 0; ++place) {
    Calendar& server = servers_[(first + place) % servers_.size()];
    there = std::max(there, server.book(opened, seconds(place), floor) + seconds(place));
  }
  return there;
}

// That which can begin first.
std::size_t StorageUse::first_server(double opened, double seconds) const {
  std::size_t first = 0;
  for (std::size_t server = 1; server < servers_.size(); ++server)
    if (servers_[server].free_at(opened, seconds) < servers_[first].free_at(opened, seconds)) first = server;
  return first;
}

}  // namespace mars::simulated
