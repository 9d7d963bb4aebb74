#include "host/render/farm/farm.h"

#include <algorithm>
#include <cstring>
#include <deque>
#include <string>
#include <unordered_map>

#include "hal/failure/failure.h"
#include "hal/nx/nx_messages.h"
#include "host/render/farm/assembly.h"
#include "host/render/farm/schedule.h"
#include "host/render/farm/tracing.h"

namespace mars::host {
namespace {

constexpr std::int32_t kCredits = 4;         // strips a node may have on the way
constexpr std::size_t kUnitsAhead = 2;       // given to a group at a time, so that it never waits for the host

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

void load_film(std::span<const std::byte> block, const FarmOptions& options, std::span<const node::Hello> hellos,
               std::size_t groups) {
  const auto least = std::min_element(hellos.begin(), hellos.end(),
                                      [](const auto& a, const auto& b) { return a.memory < b.memory; });
  const SpanOf span(HostSpan::load, block.size());
  const node::Load load{block.size(), options.memory != 0 ? options.memory : least->memory, kCredits, options.mapping,
                        static_cast<std::int32_t>(groups), options.trace != nullptr ? 1u : 0u};
  std::vector<std::byte> message(sizeof load + hellos.size() * sizeof hellos[0].machine);
  std::memcpy(message.data(), &load, sizeof load);
  for (std::size_t n = 0; n < hellos.size(); ++n)
    std::memcpy(message.data() + sizeof load + n * sizeof hellos[n].machine, &hellos[n].machine, sizeof hellos[n].machine);
  send_to_all(node::kLoad, message.data(), message.size());
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
  // A group's units are composed one after another, so it needs one saved background at most.
  struct Work {
    hal::Group group;
    Compositor compositor;       // the first unit's
    std::deque<Assembly> units;  // given to the group and not done
    std::deque<double> given;    // and when, in seconds since the start
  };

  void give_units();
  void give_when_asked();
  void give(Work& work);
  void receive();
  void receive_strip();
  bool prepare_one();
  bool compose_one();
  void submit(const Assembly::Pasted& frame, std::uint32_t interval, double given);
  void note_taken();
  Assembly& assembly_of(const node::Strip& strip);

  SinkPool& sinks_;
  const FarmListener& listener_;
  FarmReport& report_;
  Tracing& tracing_;

  bool each_frame_;
  std::vector<Unit> units_;
  std::size_t next_unit_ = 0;
  std::vector<Work> work_;
  struct OnTheWay {
    FinishedFrame frame;
    std::vector<std::int32_t> nodes;  // whose credit it holds
  };
  std::unordered_map<std::uint32_t, OnTheWay> with_sinks_;
  StripStore store_;
  std::size_t frames_left_;
  double start_;
};

Farm::Farm(const node::FilmView& film, const FarmOptions& options, SinkPool& sinks, const FarmListener& listener,
           FarmReport& report, Tracing& tracing)
    : sinks_(sinks),
      listener_(listener),
      report_(report),
      tracing_(tracing),
      each_frame_(options.each_frame),
      units_(make_units(film, options.frames, options.coherence)),
      frames_left_(options.frames.size()),
      start_(dclock()) {
  const SinkPool::Shape& shape = sinks.shape();
  const std::uint32_t background = pixel_of(film.settings().background);
  for (const hal::Group& group : make_groups(static_cast<int>(numnodes()), static_cast<int>(options.groups), units_.size()))
    work_.push_back({group, Compositor(shape.width, shape.height, shape.block, background), {}, {}});
}

void Farm::run() {
  while (frames_left_ > 0) {
    give_units();
    note_taken();
    tracing_.drain();
    if (compose_one()) continue;
    if (iprobe(node::any_of(node::kStrip, node::kFault, node::kTrace)))
      receive();
    else if (!prepare_one())
      flick();
  }
  report_.render_seconds = dclock() - start_;
  const SpanOf span(HostSpan::finish);
  sinks_.finish();
  note_taken();
}

void Farm::give_units() {
  if (listener_.more) return give_when_asked();
  // Every group gets its first before any gets one ahead: there may be few.
  for (std::size_t ahead = 1; ahead <= kUnitsAhead; ++ahead)
    for (Work& work : work_)
      if (work.units.size() < ahead && next_unit_ < units_.size()) give(work);
}

void Farm::give_when_asked() {
  if (!work_.front().units.empty() || !with_sinks_.empty() || next_unit_ == units_.size()) return;
  if (listener_.more())
    give(work_.front());
  else
    frames_left_ = 0;
}

void Farm::give(Work& work) {
  work.given.push_back(dclock() - start_);
  const Unit& unit = units_[next_unit_++];
  const SpanOf span(HostSpan::give, unit.interval);
  const hal::Group& group = work.group;
  const auto frames = static_cast<std::uint32_t>(unit.frames.size());
  const node::Render command{unit.interval, group.first, group.count, frames, unit.first_inbetween};
  std::vector<std::byte> message(sizeof command + frames * sizeof(std::uint32_t));
  std::memcpy(message.data(), &command, sizeof command);
  std::memcpy(message.data() + sizeof command, unit.frames.data(), frames * sizeof(std::uint32_t));
  for (int node = group.first; node < group.first + group.count; ++node)
    csend(node::kRender, message.data(), static_cast<long>(message.size()), node, 0);
  work.units.emplace_back(unit, group.count);
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
  StripBytes bytes = store_.take(static_cast<std::size_t>(infocount()));
  crecv(node::kStrip, bytes.data.get(), static_cast<long>(bytes.size));
  StripMessage strip(std::move(bytes));
  const node::Strip header = strip.header();
  span.set_value(header.frame);
  if (each_frame_ && header.last == 1) report_.strips.push_back(header);
  assembly_of(header).receive(std::move(strip));
  // A frame's credit is held until the sinks have it; that of its earlier strips is not.
  const node::Credit credit{1};
  if (header.last == 0) csend(node::kCredit, &credit, sizeof credit, header.node, 0);
}

Assembly& Farm::assembly_of(const node::Strip& strip) {
  for (Work& work : work_)
    for (Assembly& unit : work.units)
      if (unit.wants(strip.frame)) return unit;
  throw Failure("a strip came for a frame that was not asked for", "frame " + std::to_string(strip.frame),
                "please report it");
}

// While nothing comes: a buffer for a frame that is being drawn; whether there was one to prepare.
bool Farm::prepare_one() {
  SpanOf span(HostSpan::prepare);
  for (Work& work : work_)
    if (!work.units.empty() && work.units.front().prepare(work.compositor, sinks_)) return true;
  span.forget();
  return false;
}

// Pastes what came of one frame, if it can be; whether it did.
bool Farm::compose_one() {
  SpanOf span(HostSpan::compose);
  for (Work& work : work_) {
    if (work.units.empty()) continue;
    Assembly& unit = work.units.front();
    const std::optional<Assembly::Pasted> pasted = unit.paste(work.compositor, sinks_, store_);
    if (!pasted) continue;
    span.set_value(pasted->number);
    if (pasted->whole != nullptr) submit(*pasted, unit.interval(), work.given.front());
    if (unit.done()) {
      work.units.pop_front();
      work.given.pop_front();
      work.compositor.begin_interval();
    }
    return true;
  }
  span.forget();
  return false;
}

void Farm::submit(const Assembly::Pasted& frame, std::uint32_t interval, double given) {
  const FinishedFrame finished{frame.number, interval, frame.kind, dclock() - start_, given};
  if (each_frame_) report_.frames.push_back(finished);
  with_sinks_[frame.number] = {finished, frame.nodes};
  sinks_.submit(frame.whole);
  --frames_left_;
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
  load_film(film_block, options, report.nodes,
            make_groups(static_cast<int>(numnodes()), static_cast<int>(options.groups), units).size());
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
