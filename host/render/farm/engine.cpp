#include "host/render/farm/engine.h"

#include <algorithm>
#include <cstring>
#include <map>
#include <string>
#include <utility>

#include "hal/nx/nx_messages.h"
#include "node/wire/greeting.h"

namespace mars::farm {
namespace {

void send_load(const wire::Load& load, std::span<const wire::Hello> hellos, std::span<const std::byte> orders) {
  std::vector<std::byte> message(sizeof load + hellos.size() * sizeof hellos[0].machine);
  std::memcpy(message.data(), &load, sizeof load);
  std::byte* to = message.data() + sizeof load;
  for (const wire::Hello& hello : hellos) {
    std::memcpy(to, &hello.machine, sizeof hello.machine);
    to += sizeof hello.machine;
  }
  message.insert(message.end(), orders.begin(), orders.end());
  for (const wire::Hello& hello : hellos)
    csend(wire::kLoad, message.data(), static_cast<long>(message.size()), hello.node, 0);
}

// To the first node, which leads its machine and passes it on. The messages' ids.
std::vector<long> send_block(std::span<const std::byte> block) {
  std::vector<long> sends;
  for (std::size_t at = 0; at < block.size(); at += wire::kFilmPiece) {
    const auto piece = block.subspan(at, std::min<std::size_t>(block.size() - at, wire::kFilmPiece));
    sends.push_back(isend(wire::kFilmBlock, piece.data(), static_cast<long>(piece.size()), 0, 0));
  }
  return sends;
}

}  // namespace

void WorkGiver::rest() { flick(); }

Engine::Engine(const EngineOptions& options)
    : options_(options),
      slots_(static_cast<int>(numnodes()), options.credits, options.format),
      inbox_(options.width, options.height, options.format, slots_, options.cancellation, options.watched),
      assignments_(static_cast<std::size_t>(numnodes())) {
  if (options_.heartbeats != nullptr)
    options_.heartbeats->ask_for_drawing(
        [this](int node, std::int32_t begun) { return assignments_.drawn_by(node, begun); });
}

Engine::~Engine() {
  if (options_.heartbeats != nullptr) options_.heartbeats->ask_for_drawing({});
}

bool Engine::shake_hands() {
  set_doing("waiting for nodes");
  if (!inbox_.receive_hellos()) return false;
  if (options_.heartbeats != nullptr) options_.heartbeats->watch(inbox_.hellos());
  tracing_.emplace(options_.trace, inbox_);
  return true;
}

bool Engine::load_film(std::span<const std::byte> block, wire::Load load, std::span<const std::byte> orders) {
  const ScopedSpan span(trace::HostSpan::load, block.size());
  set_doing("loading");
  load.stamp = wire::own_stamp();
  load.film_bytes = block.size();
  load.orders = orders.size();
  load.credits = options_.credits;
  load.pixel_format = options_.format;
  load.traced = options_.trace != nullptr ? 1 : 0;
  load.watched = options_.watched ? 1 : 0;
  inbox_.expect_loaded();
  send_load(load, inbox_.hellos(), orders);
  const std::vector<long> sends = send_block(block);
  const bool loaded = inbox_.wait_until_loaded();
  for (const long send : sends) msgwait(send);
  if (loaded) slots_.give_all();
  return loaded;
}

void Engine::run(WorkGiver& giver, PictureTaker& taker) {
  begun_ = dclock();
  while (giver.goes_on() && !cancelled()) {
    if (options_.heartbeats != nullptr) options_.heartbeats->look();
    const bool gave = giver.give_work();
    tracing_->drain();
    const double turn = dclock();
    if (taker.compose() || hear(giver, taker) || taker.prepare())
      busy_seconds_ += dclock() - turn;
    else if (!gave)
      giver.rest();
  }
}

// Whether something had come.
bool Engine::hear(WorkGiver& giver, PictureTaker& taker) {
  if (hear_strip(false, giver, taker)) return true;
  if (!iprobe(wire::any_of(wire::kStrip, wire::kFault, wire::kTrace, wire::kDrawn, wire::kWritten, wire::kStorage)))
    return false;
  switch (infotype()) {
    case wire::kFault: inbox_.receive_fault();
    case wire::kTrace: tracing_->receive(); break;
    case wire::kDrawn: hear_drawn(giver, taker); break;
    case wire::kWritten: hear_written(taker); break;
    case wire::kStorage: taker.warn(inbox_.receive_storage_warning()); break;
    default: hear_strip(true, giver, taker);
  }
  return true;
}

// The one that was probed, or one whose bytes were on their way until now; whether there is one.
bool Engine::hear_strip(bool probed, WorkGiver& giver, PictureTaker& taker) {
  ScopedSpan span(trace::HostSpan::strip);
  std::optional<StripMessage> strip = probed ? inbox_.receive_strip(store_) : inbox_.finished_strip();
  if (!strip) {
    span.forget();
    return false;
  }
  const wire::Strip header = strip->header();
  span.set_value(header.frame);
  note_given(header, false, taker);
  taker.take_strip(std::move(*strip));
  giver.note_taken(header);
  return true;
}

void Engine::hear_drawn(WorkGiver& giver, PictureTaker& taker) {
  const wire::Strip drawn = inbox_.receive_drawn();
  note_given(drawn, true, taker);
  taker.take_drawn(drawn);
  giver.note_taken(drawn);
}

void Engine::hear_written(PictureTaker& taker) {
  const wire::Written written = inbox_.receive_written();
  if (!taker.take_written(written)) inbox_.refuse(written.node, "word of a file that it was not asked for");
}

void Engine::note_given(const wire::Strip& strip, bool is_drawn, const PictureTaker& taker) {
  if (!assignments_.has(strip) || !taker.expects(strip, is_drawn))
    inbox_.refuse(strip.node, "a strip of frame " + std::to_string(strip.frame) + " that it was not asked for");
  if (options_.heartbeats != nullptr) options_.heartbeats->hear(strip);
  if (strip.last == 1) assignments_.end(strip);
}

void Engine::stop(bool idle) {
  if (tracing_ && idle) tracing_->read_clocks_again();
  if (options_.heartbeats != nullptr) options_.heartbeats->forget_nodes();
  send(all(), wire::kStop, {});
  if (tracing_) tracing_->finish();
}

void Engine::send(const collectives::Group& nodes, long type, std::span<const std::byte> message) {
  for (int node = nodes.first; node < nodes.first + nodes.count; ++node)
    csend(type, message.data(), static_cast<long>(message.size()), node, 0);
}

std::uint64_t Engine::node_memory() const { return std::ranges::min(inbox_.hellos(), {}, &wire::Hello::memory).memory; }

int Engine::nodes_together() const {
  std::map<std::int32_t, int> nodes;
  for (const wire::Hello& hello : inbox_.hellos()) ++nodes[hello.machine];
  return std::ranges::max_element(nodes, {}, &std::pair<const std::int32_t, int>::second)->second;
}

double Engine::seconds() const { return dclock() - begun_; }

void Engine::set_doing(const std::string& doing) {
  if (options_.heartbeats != nullptr) options_.heartbeats->set_doing(doing);
}

}  // namespace mars::farm
