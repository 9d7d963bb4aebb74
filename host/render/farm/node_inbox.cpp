#include "host/render/farm/node_inbox.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <set>
#include <utility>

#include "hal/nx/nx_messages.h"
#include "node/wire/greeting.h"

namespace mars::farm {
namespace {

bool is_control(char c) { return (c >= 0 && c < ' ') || c == 127; }

// Ends, and has nothing that would act on a terminal.
template <std::size_t N>
bool is_text(const std::array<char, N>& text) {
  const auto end = std::find(text.begin(), text.end(), '\0');
  return end != text.end() && std::none_of(text.begin(), end, is_control);
}

// Seconds of a clock, few enough to be counted in nanoseconds.
bool is_time(double seconds) { return std::abs(seconds) < 4e9; }

std::string node_name(int node) { return "node " + std::to_string(node); }

// MARS before 0.2.0 had no stamp, and the name further behind.
constexpr std::size_t kUnstampedHello = 184, kUnstampedName = 40;

// The name of its machine, which every version's Hello has behind the stamp; "" if there is none.
std::string machine_in(std::span<const std::byte> hello) {
  std::array<char, sizeof wire::Hello::host> name{};
  std::size_t at = sizeof(wire::WireStamp);
  if (!wire::is_stamped(hello)) {
    if (hello.size() != kUnstampedHello) return "";
    at = kUnstampedName;
  }
  if (hello.size() < at + name.size()) return "";
  std::memcpy(name.data(), hello.data() + at, name.size());
  return is_text(name) ? name.data() : "";
}

}  // namespace

std::string with_machine(const std::string& machine, int node) {
  return machine.empty() ? node_name(node) : machine + " (" + node_name(node) + ")";
}

std::optional<wire::Beat> read_beat(std::span<const std::byte> message) {
  wire::Beat beat;
  if (message.size() != sizeof beat) return std::nullopt;
  std::memcpy(&beat, message.data(), sizeof beat);
  const bool sound = is_text(beat.host) && beat.traced <= 1 && beat.waits <= 1 && beat.frame >= -1 &&
                     beat.phase >= wire::Phase::dice && beat.phase <= wire::Phase::storage;
  return sound ? std::optional(beat) : std::nullopt;
}

NodeFailure::NodeFailure(const std::string& reason, int node, int frame)
    : Failure(reason, node_name(node) + (frame < 0 ? "" : ", frame " + std::to_string(frame)), ""),
      node(node),
      frame(frame) {}

NodeFailure::NodeFailure(const std::string& reason, const std::string& where, int node)
    : Failure(reason, where, "please report it"), node(node), frame(-1) {}

NodeFailure NodeFailure::hangs(const std::string& where, const std::string& doing, int seconds, int node, int frame) {
  const std::string of_frame = frame < 0 ? "" : " of frame " + std::to_string(frame);
  return {Failure("hangs: it has said nothing for " + std::to_string(seconds) + " s; it said last: " + doing + of_frame,
                  where, "see whether its machine answers, and start the rendering again"),
          node, frame};
}

NodeInbox::NodeInbox(std::uint32_t width, std::uint32_t height, wire::PixelFormat format, NodeSlots& slots,
                     const Cancellation* cancellation, bool watched)
    : width_(width),
      height_(height),
      format_(format),
      slots_(slots),
      cancellation_(cancellation),
      watched_(watched),
      nodes_(static_cast<int>(numnodes())),
      receipts_(nodes_),
      hellos_(static_cast<std::size_t>(nodes_)),
      is_known_(hellos_.size()),
      loaded_(hellos_.size()),
      sees_folder_(hellos_.size(), true),
      apart_(hellos_.size()),
      ended_(hellos_.size()) {}

std::string NodeInbox::name_of(int node) const {
  const auto index = static_cast<std::size_t>(node);
  return with_machine(is_known_.at(index) ? hellos_[index].host.data() : "", node);
}

void NodeInbox::refuse(int node, const std::string& what) const {
  throw NodeFailure("sent " + what, name_of(node), node);
}

void NodeInbox::require(bool holds, int node, const char* what) const {
  if (!holds) refuse(node, what);
}

void NodeInbox::wait(long type) const {
  cprobe(wire::any_of(type, long{wire::kFault}));
  if (infotype() == wire::kFault) receive_fault();
}

bool NodeInbox::wait_unless_cancelled(long type) const {
  while (cancellation_ != nullptr && iprobe(wire::any_of(type, long{wire::kFault})) == 0) {
    if (cancellation_->cancelled()) return false;
    flick();
  }
  wait(type);
  return true;
}

bool NodeInbox::receive_hellos() {
  for (int i = 0; i < nodes_; ++i) {
    if (!wait_unless_cancelled(wire::kHello)) return false;
    receive_hello();
  }
  check_machines();
  return true;
}

void NodeInbox::receive_hello() {
  const int node = static_cast<int>(infonode());
  std::vector<std::byte> message(static_cast<std::size_t>(infocount()));
  crecv(wire::kHello, message.data(), static_cast<long>(message.size()));
  wire::check_stamp(message, with_machine(machine_in(message), node), "the host");
  require(message.size() == sizeof(wire::Hello), node, "a greeting of another size");
  wire::Hello hello;
  std::memcpy(&hello, message.data(), sizeof hello);
  require(is_text(hello.host) && is_text(hello.binding) && is_text(hello.simd) && is_text(hello.apart), node,
          "names that are no text");
  const auto index = static_cast<std::size_t>(node);
  require(hello.node == node && !is_known_[index], node, "another node's greeting");
  hellos_[index] = hello;
  is_known_[index] = true;
}

// The lowest of a machine's nodes gets the film for all.
void NodeInbox::check_machines() const {
  for (const wire::Hello& hello : hellos_) {
    const bool known = hello.machine >= 0 && hello.machine <= hello.node &&
                       hellos_[static_cast<std::size_t>(hello.machine)].machine == hello.machine;
    require(known, hello.node, "a machine that is not there");
  }
}

bool NodeInbox::wait_until_loaded() {
  for (int i = 0; i < nodes_; ++i) {
    if (!wait_unless_cancelled(wire::kLoaded)) return false;
    receive_loaded();
  }
  return true;
}

void NodeInbox::receive_loaded() {
  const int node = static_cast<int>(infonode());
  wire::Loaded loaded;
  const bool first = !loaded_[static_cast<std::size_t>(node)];
  require(infocount() == sizeof loaded && first, node, "word of the film that makes no sense");
  crecv(wire::kLoaded, &loaded, sizeof loaded);
  require(is_text(loaded.apart), node, "a reason that is no text");
  loaded_[static_cast<std::size_t>(node)] = true;
  apart_[static_cast<std::size_t>(node)] = loaded.apart.data();
  sees_folder_[static_cast<std::size_t>(node)] = loaded.unseen == 0;
  slots_.attach(node, loaded.slots);
}

std::vector<std::string> NodeInbox::apart() const {
  std::set<std::string> machines;  // that are reported
  std::vector<std::string> texts;
  for (std::size_t node = 0; node < apart_.size(); ++node) {
    const std::string host = hellos_[node].host.data();
    if (!apart_[node].empty() && machines.insert(host).second)
      texts.push_back("nodes on " + host + " do not read each other's triangles in place (" + apart_[node] +
                      "): they send them, which takes longer; raise the limit, or set MARS_MEMORY to fewer MiB");
  }
  return texts;
}

std::optional<StripMessage> NodeInbox::receive_strip(StripStore& store) {
  const int node = static_cast<int>(infonode());
  if (slots_.attached(node)) return checked(receive_by_slot(node, store), node);
  begin_message(node, store);
  return finished_message(node);
}

std::optional<StripMessage> NodeInbox::finished_strip() {
  for (const int node : receipts_.nodes())
    if (auto strip = finished_message(node)) return strip;
  return std::nullopt;
}

StripMessage NodeInbox::checked(std::optional<StripMessage> strip, int node) const {
  require(strip.has_value(), node, "a strip that is not what its header says");
  check_strip(strip->header(), strip->runs(), node);
  return std::move(*strip);
}

// In which slot it was made shows when it has come; until then it takes the host's memory.
void NodeInbox::begin_message(int node, StripStore& store) {
  const auto size = static_cast<std::size_t>(infocount());
  require(size >= sizeof(wire::Strip) && size <= wire::max_strip_bytes(format_), node, "a strip of an impossible size");
  require(receipts_.count(node) < slots_.owned(node), node, "a strip in a slot that it does not have");
  receipts_.begin(node, store.take(size));
}

std::optional<StripMessage> NodeInbox::finished_message(int node) {
  std::optional<StripBytes> bytes = receipts_.take(node);
  if (!bytes) return std::nullopt;
  std::optional<StripMessage> strip = StripMessage::read(std::move(*bytes), format_, watched_);
  if (strip) take_slot(strip->header(), node);
  return checked(std::move(strip), node);
}

std::optional<StripMessage> NodeInbox::receive_by_slot(int node, StripStore& store) {
  wire::Strip header;
  require(infocount() == sizeof header, node, "a strip of an impossible size");
  crecv(wire::kStrip, &header, sizeof header);
  take_slot(header, node);
  return StripMessage::read(header, slots_.bytes({node, header.slot}), format_, store, watched_);
}

void NodeInbox::take_slot(const wire::Strip& strip, int sender) {
  require(strip.node == sender, sender, "another node's strip");
  require(slots_.take({sender, strip.slot}), sender, "a strip in a slot that it does not have");
}

void NodeInbox::check_strip(const wire::Strip& strip, std::span<const wire::Run> runs, int sender) const {
  require(strip.last <= 1, sender, "a strip that is neither the last nor another");
  require(strip.cut <= strip.last, sender, "a strip that is cut and not the last");
  require(strip.first_line <= strip.last_line && strip.last_line <= height_, sender, "lines outside the picture");
  for (const wire::Run& run : runs) {
    require(run.line >= strip.first_line && run.line < strip.last_line, sender, "pixels outside the strip's lines");
    require(run.count > 0 && std::uint32_t{run.first} + run.count <= width_, sender, "pixels outside the picture");
  }
}

wire::Strip NodeInbox::receive_drawn() const {
  const int node = static_cast<int>(infonode());
  wire::Strip drawn;
  require(infocount() == sizeof drawn, node, "word of a frame of an impossible size");
  crecv(wire::kDrawn, &drawn, sizeof drawn);
  require(drawn.node == node && drawn.last == 1, node, "word of a frame that makes no sense");
  check_strip(drawn, {}, node);
  return drawn;
}

wire::Written NodeInbox::receive_written() const {
  const int node = static_cast<int>(infonode());
  wire::Written written;
  require(infocount() == sizeof written, node, "word of a file of an impossible size");
  crecv(wire::kWritten, &written, sizeof written);
  require(written.node == node && is_text(written.pixel_hash) && is_time(written.seconds), node,
          "word of a file that makes no sense");
  return written;
}

std::string NodeInbox::receive_storage_warning() const {
  constexpr long kLongest = 1 << 14;
  const int node = static_cast<int>(infonode());
  require(infocount() <= kLongest, node, "a warning of an impossible size");
  std::string text(static_cast<std::size_t>(infocount()), ' ');
  crecv(wire::kStorage, text.data(), static_cast<long>(text.size()));
  std::ranges::replace_if(text, is_control, ' ');
  return name_of(node) + ": " + text;
}

std::span<const messages::Event> NodeInbox::receive_events() {
  const int node = static_cast<int>(infonode());
  const auto size = static_cast<std::size_t>(infocount());
  require(size > 0 && size % sizeof(messages::Event) == 0, node, "events of an impossible size");
  events_.resize(size / sizeof(messages::Event));
  crecv(wire::kTrace, events_.data(), static_cast<long>(size));
  const auto index = static_cast<std::size_t>(node);
  const auto recorded = std::span(events_).first(events_.size() - 1);
  const bool sound = !ended_[index] && events_.back().kind == messages::Event::Kind::lost &&
                     std::all_of(recorded.begin(), recorded.end(), [this](const auto& e) { return is_event(e); });
  require(sound, node, "events that make no sense");
  ended_[index] = events_.back().number == 1;
  return events_;
}

bool NodeInbox::is_event(const messages::Event& event) const {
  using Kind = messages::Event::Kind;
  if (!is_time(event.begin) || !is_time(event.end)) return false;
  switch (event.kind) {
    case Kind::span: return event.what >= 0 && event.what <= static_cast<int>(wire::Phase::inbetween);
    case Kind::sent:
    case Kind::taken: return event.what >= 0 && event.peer >= 0 && event.peer <= nodes_;
    case Kind::waited: return event.what >= -1 && event.peer >= -1 && event.peer <= nodes_;
    case Kind::lost: return false;
  }
  return false;
}

double NodeInbox::receive_time(int node) {
  wait(wire::kClock);
  double time = 0;
  require(infocount() == sizeof time, static_cast<int>(infonode()), "a time of an impossible size");
  require(infonode() == node, static_cast<int>(infonode()), "a time that was not asked for");
  crecv(wire::kClock, &time, sizeof time);
  require(is_time(time), node, "a time that makes no sense");
  return time;
}

void NodeInbox::receive_fault() const {
  const int node = static_cast<int>(infonode());
  require(infocount() == sizeof(wire::Fault), node, "a fault of an impossible size");
  wire::Fault fault;
  crecv(wire::kFault, &fault, sizeof fault);
  fault.reason.back() = '\0';
  std::replace_if(fault.reason.begin(), std::find(fault.reason.begin(), fault.reason.end(), '\0'), is_control, ' ');
  throw NodeFailure(fault.reason.data(), node, std::max(fault.frame, -1));
}

}  // namespace mars::farm
