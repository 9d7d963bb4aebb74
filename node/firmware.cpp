#include "node/firmware.h"

#include <algorithm>
#include <cstddef>
#include <exception>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "hal/failure/explain.h"
#include "hal/failure/failure.h"
#include "hal/messages/shared_memory.h"
#include "hal/nx/nx_global.h"
#include "hal/nx/nx_messages.h"
#include "node/command_queue.h"
#include "node/film_frames.h"
#include "node/film_receiver.h"
#include "node/heartbeat.h"
#include "node/live_views.h"
#include "node/renderer.h"
#include "node/simd/instruction_set.h"
#include "node/wire/commands.h"
#include "node/wire/film.h"
#include "node/wire/greeting.h"
#include "node/wire/protocol.h"

namespace mars::node {
namespace {

constexpr std::uint64_t kFilmReplica = 0;

template <std::size_t N>
void copy_text(const std::string& text, std::array<char, N>& out) {
  out = {};
  std::copy_n(text.begin(), std::min(text.size(), N - 1), out.begin());
}

class Firmware {
 public:
  explicit Firmware(const NodeIdentity& identity);

  void run();
  // The last message of a node that has failed.
  void report_fault(const std::string& reason);

 private:
  void load();
  void forget_film();
  void render();
  void write_files();
  void report_files_until_command();
  void send_time();
  Renderer& renderer() { return given(renderer_); }
  // What there is once a film is loaded, if it is for such work.
  template <typename T>
  T& given(std::optional<T>& item) const;

  simd::InstructionSet instruction_set_;
  const std::string name_;  // as in failures
  const wire::MakeFrameWriter make_frame_writer_;
  Heartbeat heartbeat_;
  std::optional<messages::SharedMemory> film_block_;
  std::optional<wire::PackedFilm> film_;
  std::unique_ptr<wire::FrameWriter> frame_writer_;  // none: frames go to the host
  std::optional<Renderer> renderer_;
  std::optional<FilmFrames> film_frames_;  // either
  std::optional<LiveViews> views_;         // or
  int groups_ = 1;
  CommandQueue commands_;
  std::vector<std::uint32_t> frames_;  // that it asks for, where it does not list them
  std::vector<std::uint32_t> left_;    // inbetweens of its interval that are drawn later
};

Firmware::Firmware(const NodeIdentity& identity)
    : instruction_set_(simd::best_instruction_set(identity.simd)),
      name_(identity.host + " (node " + std::to_string(mynode()) + ")"),
      make_frame_writer_(identity.make_frame_writer),
      heartbeat_(identity) {
  wire::Hello hello{};
  hello.stamp = wire::own_stamp();
  hello.node = static_cast<std::int32_t>(mynode());
  const messages::Neighbourhood here = messages::neighbourhood();
  hello.machine = here.machine;
  hello.rank = here.rank;
  hello.seat = identity.seat;
  hello.memory = identity.memory;
  copy_text(identity.host, hello.host);
  copy_text(identity.binding, hello.binding);
  copy_text(simd::name_of(instruction_set_), hello.simd);
  copy_text(here.refusal, hello.apart);
  csend(wire::kHello, &hello, sizeof hello, myhost(), 0);
}

void Firmware::run() {
  for (;;) {
    led(0);
    heartbeat_.rest();
    report_files_until_command();
    const long type = commands_.wait();
    led(1);
    switch (type) {
      case wire::kLoad: load(); break;
      case wire::kRender: render(); break;
      case wire::kBeginView: given(views_).begin(commands_.receive()); break;
      case wire::kDraw: given(views_).draw(commands_.receive()); break;
      case wire::kCloseView: given(views_).close(commands_.receive()); break;
      case wire::kWrite: write_files(); break;
      case wire::kCredit: renderer().outbox().receive_credit(); break;
      case wire::kStop:
        wire::check_size("Stop", commands_.receive().size(), 0);
        if (renderer_) renderer_->finish();
        return;
      case wire::kClock: send_time(); break;
    }
  }
}

// The machine's first node receives the film into memory that all nodes of the machine share, and checks it.
void Firmware::load() {
  const auto [load, machines, orders] = wire::read_load(commands_.receive(), static_cast<int>(numnodes()), name_);
  const messages::Neighbourhood here = messages::neighbourhood();
  wire::check_machines(machines, static_cast<int>(mynode()), here.machine, here.count);
  forget_film();
  film_block_.emplace(kFilmReplica, load.film_bytes);
  const auto block = film_block_->bytes();
  if (here.index == 0) {
    receive_film(block, machines);
    wire::PackedFilm(block, "film");
  }
  gsync();
  film_.emplace(block, "film", true);
  if (load.live == 0) wire::check_pixels(load.pixel_format, film_->settings().samples);
  if (load.orders > 0) {
    if (!make_frame_writer_) throw Failure("this node writes no files", name_, "use --write host");
    frame_writer_ = make_frame_writer_(*film_, orders);
  }
  renderer_.emplace(load, machines, instruction_set_, heartbeat_, frame_writer_.get());
  if (load.live == 1)
    views_.emplace(*film_, instruction_set_, *renderer_, [this](std::uint32_t view) { return commands_.ends(view); });
  else
    film_frames_.emplace(*film_, load, instruction_set_, *renderer_);
  groups_ = load.groups;
  const std::size_t most = film_->settings().frames;
  commands_.reserve(sizeof(wire::Render) + (most + std::min(most, wire::kMostCycle)) * sizeof(std::uint32_t));
  frames_.reserve(most);
  left_.reserve(most);
  const bool sees_folder = !frame_writer_ || frame_writer_->sees_folder();
  wire::Loaded loaded{renderer_->outbox().slots(), {}, sees_folder ? 0u : 1u};
  copy_text(renderer_->refusal(), loaded.apart);
  csend(wire::kLoaded, &loaded, sizeof loaded, myhost(), 0);
}

// What was sent is in its memory until it is gone.
void Firmware::forget_film() {
  views_.reset();
  film_frames_.reset();
  if (renderer_) renderer_->finish();
  renderer_.reset();
  frame_writer_.reset();
}

void Firmware::render() {
  FilmFrames& frames = given(film_frames_);
  const wire::RenderReceiver self{static_cast<int>(mynode()), static_cast<int>(numnodes()), groups_, left_};
  const wire::RenderCommand command = wire::read_render(commands_.receive(), *film_, self, frames_);
  if (command.render.goes_on == 1)
    left_.erase(left_.begin(), left_.begin() + command.render.drawn);
  else
    left_.assign(command.left().begin(), command.left().end());
  frames.render(command);
}

void Firmware::write_files() {
  wire::check_size("Write", commands_.receive().size(), 0);
  if (!frame_writer_) throw Failure("the host asks for files without saying where", "", "please report it");
  given(film_frames_).write_files();
}

// A file may be whole while the node has nothing to do.
void Firmware::report_files_until_command() {
  if (!frame_writer_) return;
  while (frame_writer_->is_busy() && !commands_.has_come()) {
    renderer_->report_files();
    flick();
  }
}

void Firmware::send_time() {
  wire::check_size("Clock", commands_.receive().size(), 0);
  const double now = dclock();
  csend(wire::kClock, &now, sizeof now, myhost(), 0);
}

template <typename T>
T& Firmware::given(std::optional<T>& item) const {
  if (!item) throw Failure("the host gives work before a film", "", "please report it");
  return *item;
}

void Firmware::report_fault(const std::string& reason) {
  wire::Fault fault{};
  fault.node = static_cast<std::int32_t>(mynode());
  if (renderer_) renderer_->send_trace();
  fault.frame = renderer_ ? static_cast<std::int32_t>(renderer_->frame()) : -1;
  copy_text(reason, fault.reason);
  csend(wire::kFault, &fault, sizeof fault, myhost(), 0);
}

}  // namespace

void run_node(const NodeIdentity& identity) {
  Firmware firmware(identity);
  try {
    firmware.run();
  } catch (const HostLost&) {
    throw;
  } catch (const std::exception& failure) {
    firmware.report_fault(reason_of(failure));
    crecv(wire::kStop, nullptr, 0);  // the host ends the run; leaving first would take the reason with it
    throw;
  }
}

}  // namespace mars::node
