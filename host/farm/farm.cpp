#include "host/farm/farm.h"

#include <algorithm>
#include <cstring>
#include <deque>
#include <list>
#include <string>
#include <unordered_map>

#include "hal/failure.h"
#include "hal/nx.h"
#include "host/farm/assembly.h"
#include "host/farm/schedule.h"
#include "host/farm/tracing.h"

namespace mars::host {
namespace {

constexpr std::int32_t kCredits = 4;         // strips a node may have on the way
constexpr std::size_t kUnitsAhead = 2;       // given to a cube at a time, so that it never waits for the host

void send_to_all(long type, const void* data, std::size_t bytes) {
  for (long node = 0; node < numnodes(); ++node) csend(type, data, static_cast<long>(bytes), node, 0);
}

[[noreturn]] void receive_fault() {
  node::Fault fault;
  crecv(node::kFault, &fault, sizeof fault);
  fault.reason.back() = '\0';
  throw NodeFailure(fault.reason.data(), fault.node, fault.frame);
}

// Waits for a message of `type` from every node; faults end the waiting.
template <typename Receive>
void receive_from_all(long type, const Receive& receive) {
  for (long i = 0; i < numnodes(); ++i) {
    cprobe(node::any_of(type, long{node::kFault}));
    if (infotype() == node::kFault) receive_fault();
    receive();
  }
}

std::vector<node::Hello> receive_hellos() {
  std::vector<node::Hello> hellos(static_cast<std::size_t>(numnodes()));
  receive_from_all(node::kHello, [&] {
    node::Hello hello;
    crecv(node::kHello, &hello, sizeof hello);
    hellos.at(static_cast<std::size_t>(hello.node)) = hello;
  });
  return hellos;
}

void load_film(std::span<const std::byte> block, const FarmOptions& options, std::span<const node::Hello> hellos) {
  const auto least = std::min_element(hellos.begin(), hellos.end(),
                                      [](const auto& a, const auto& b) { return a.memory < b.memory; });
  const SpanOf span(HostSpan::load, block.size());
  const node::Load load{block.size(), options.memory != 0 ? options.memory : least->memory, kCredits, options.mapping,
                        options.trace != nullptr ? 1u : 0u};
  send_to_all(node::kLoad, &load, sizeof load);
  std::vector<long> sends;
  for (const node::Hello& hello : hellos)
    if (hello.machine == hello.node)
      sends.push_back(isend(node::kFilmBlock, block.data(), static_cast<long>(block.size()), hello.node, 0));
  receive_from_all(node::kLoaded, [] { crecv(node::kLoaded, nullptr, 0); });
  for (const long send : sends) msgwait(send);
}

class Farm {
 public:
  Farm(const node::FilmView& film, const FarmOptions& options, SinkPool& sinks, const FarmListener& listener,
       FarmReport& report, Tracing& tracing);

  void run();

 private:
  void give_units();
  void give(std::size_t cube);
  void receive();
  void receive_strip();
  bool compose_one();
  void note_taken();
  Assembly& assembly_of(const node::Strip& strip);
  std::vector<std::byte> buffer_of(std::size_t bytes);
  Compositor spare_compositor();

  SinkPool& sinks_;
  const FarmListener& listener_;
  FarmReport& report_;
  Tracing& tracing_;
  std::uint32_t background_;

  std::vector<Unit> units_;
  std::size_t next_unit_ = 0;
  std::vector<hal::Cube> cubes_;
  std::vector<std::size_t> units_given_;  // to each cube and not done
  struct Running {
    std::size_t cube;
    std::uint32_t interval;
    Assembly assembly;
  };
  std::list<Running> running_;
  struct OnTheWay {
    FinishedFrame frame;
    std::vector<std::int32_t> nodes;  // whose credit it holds
  };
  std::unordered_map<std::uint32_t, OnTheWay> with_sinks_;
  std::vector<std::vector<std::byte>> spare_buffers_;
  std::vector<Compositor> spare_compositors_;
  std::size_t frames_left_;
  double start_;
};

Farm::Farm(const node::FilmView& film, const FarmOptions& options, SinkPool& sinks, const FarmListener& listener,
           FarmReport& report, Tracing& tracing)
    : sinks_(sinks),
      listener_(listener),
      report_(report),
      tracing_(tracing),
      background_(pixel_of(film.settings().background)),
      units_(make_units(film, options.frames, options.coherence)),
      cubes_(make_cubes(static_cast<int>(numnodes()), static_cast<int>(options.cubes), units_.size())),
      units_given_(cubes_.size()),
      frames_left_(options.frames.size()),
      start_(dclock()) {}

void Farm::run() {
  while (frames_left_ > 0) {
    give_units();
    note_taken();
    tracing_.drain();
    if (compose_one()) continue;
    if (iprobe(node::any_of(node::kStrip, node::kFault, node::kTrace)))
      receive();
    else
      flick();
  }
  report_.render_seconds = dclock() - start_;
  const SpanOf span(HostSpan::finish);
  sinks_.finish();
  note_taken();
}

void Farm::give_units() {
  // Every cube gets its first before any gets one ahead: there may be few.
  for (std::size_t ahead = 1; ahead <= kUnitsAhead; ++ahead)
    for (std::size_t cube = 0; cube < cubes_.size(); ++cube)
      if (units_given_[cube] < ahead && next_unit_ < units_.size()) give(cube);
}

void Farm::give(std::size_t number) {
  const Unit& unit = units_[next_unit_++];
  const SpanOf span(HostSpan::give, unit.interval);
  const hal::Cube& cube = cubes_[number];
  const auto frames = static_cast<std::uint32_t>(unit.frames.size());
  const node::Render command{unit.interval, cube.first, cube.count, frames, unit.first_inbetween};
  std::vector<std::byte> message(sizeof command + frames * sizeof(std::uint32_t));
  std::memcpy(message.data(), &command, sizeof command);
  std::memcpy(message.data() + sizeof command, unit.frames.data(), frames * sizeof(std::uint32_t));
  running_.push_back({number, unit.interval, Assembly(unit, cube, spare_compositor())});
  ++units_given_[number];
  for (int node = cube.first; node < cube.first + cube.count; ++node)
    csend(node::kRender, message.data(), static_cast<long>(message.size()), node, 0);
}

void Farm::receive() {
  switch (infotype()) {
    case node::kFault: receive_fault();
    case node::kTrace: tracing_.receive(); break;
    default: receive_strip();
  }
}

void Farm::receive_strip() {
  SpanOf span(HostSpan::strip);
  std::vector<std::byte> bytes = buffer_of(static_cast<std::size_t>(infocount()));
  crecv(node::kStrip, bytes.data(), static_cast<long>(bytes.size()));
  StripMessage strip(std::move(bytes));
  const node::Strip header = strip.header();
  span.set_value(header.frame);
  if (header.last == 1) report_.strips.push_back(header);
  assembly_of(header).receive(std::move(strip));
  // A frame's credit is held until the sinks have it; that of its earlier strips is not.
  const node::Credit credit{1};
  if (header.last == 0) csend(node::kCredit, &credit, sizeof credit, header.node, 0);
}

Assembly& Farm::assembly_of(const node::Strip& strip) {
  const auto wants = [&](const Running& r) { return r.assembly.wants(strip.frame); };
  const auto found = std::find_if(running_.begin(), running_.end(), wants);
  if (found == running_.end())
    throw Failure("a strip came for a frame that was not asked for", "frame " + std::to_string(strip.frame),
                  "please report it");
  return found->assembly;
}

// Composes one frame if one is ready and a buffer is free; whether it did.
bool Farm::compose_one() {
  const auto ready = std::find_if(running_.begin(), running_.end(), [](const Running& r) { return r.assembly.ready(); });
  if (ready == running_.end()) return false;
  Frame* frame = sinks_.free_frame(ready->assembly.background_name());
  if (frame == nullptr) return false;
  SpanOf span(HostSpan::compose);
  Assembly::Composed composed = ready->assembly.compose(*frame);
  span.set_value(composed.frame);
  const FinishedFrame finished{composed.frame, ready->interval, composed.kind, dclock() - start_};
  report_.frames.push_back(finished);
  with_sinks_[composed.frame] = {finished, std::move(composed.nodes)};
  sinks_.submit(frame);
  --frames_left_;
  std::move(composed.bytes.begin(), composed.bytes.end(), std::back_inserter(spare_buffers_));
  if (ready->assembly.done()) {
    --units_given_[ready->cube];
    spare_compositors_.push_back(ready->assembly.release());
    running_.erase(ready);
  }
  return true;
}

void Farm::note_taken() {
  const node::Credit credit{1};
  for (const SinkPool::Taken& taken : sinks_.taken()) {
    tracing_.taken(taken);
    const auto found = with_sinks_.find(taken.number);
    for (const std::int32_t node : found->second.nodes) csend(node::kCredit, &credit, sizeof credit, node, 0);
    if (listener_.finished) listener_.finished(found->second.frame);
    with_sinks_.erase(found);
  }
}

std::vector<std::byte> Farm::buffer_of(std::size_t bytes) {
  std::vector<std::byte> buffer;
  if (!spare_buffers_.empty()) {
    buffer = std::move(spare_buffers_.back());
    spare_buffers_.pop_back();
  }
  buffer.resize(bytes);
  return buffer;
}

Compositor Farm::spare_compositor() {
  const SinkPool::Shape& shape = sinks_.shape();
  if (spare_compositors_.empty()) return {shape.width, shape.height, shape.block, background_};
  Compositor spare = std::move(spare_compositors_.back());
  spare_compositors_.pop_back();
  return spare;
}

}  // namespace

NodeFailure::NodeFailure(const std::string& reason, int who, int at)
    : Failure(reason, "node " + std::to_string(who) + (at < 0 ? "" : ", frame " + std::to_string(at)), ""),
      node(who),
      frame(at) {}

std::uint32_t pixel_of(const std::array<float, 3>& color) {
  std::uint32_t pixel = 0;
  for (int c = 0; c < 3; ++c) {
    const float level = std::clamp(color[static_cast<std::size_t>(c)], 0.0f, 1.0f) * 255.0f + 0.5f;
    pixel |= static_cast<std::uint32_t>(level) << (8 * c);
  }
  return pixel;
}

FarmReport render_film(std::span<const std::byte> film_block, const FarmOptions& options, SinkPool& sinks,
                       const FarmListener& listener) {
  const node::FilmView film(film_block, "film");
  FarmReport report;
  report.film_bytes = film_block.size();
  report.nodes = receive_hellos();
  const double booted = dclock();
  const auto units = static_cast<std::uint32_t>(make_units(film, options.frames, options.coherence).size());
  if (listener.booted) listener.booted(report.nodes, units, static_cast<std::uint32_t>(options.frames.size()) - units);
  Tracing tracing(options.trace, report.nodes, kCredits);
  load_film(film_block, options, report.nodes);
  report.load_seconds = dclock() - booted;
  const double start = dclock();
  Farm(film, options, sinks, listener, report, tracing).run();
  report.total_seconds = dclock() - start;
  tracing.read_clocks_again();
  send_to_all(node::kStop, nullptr, 0);
  while (tracing.nodes_left() > 0) {
    cprobe(node::kTrace);
    tracing.receive();
  }
  return report;
}

}  // namespace mars::host
