#include "node/firmware.h"

#include <algorithm>
#include <optional>
#include <span>
#include <vector>

#include "hal/failure/explain.h"
#include "hal/nx/nx_global.h"
#include "hal/nx/nx_messages.h"
#include "hal/messages/shared_memory.h"
#include "node/wire/film.h"
#include "node/simd/instruction_set.h"
#include "node/wire/protocol.h"
#include "node/renderer.h"

namespace mars::node {
namespace {

template <std::size_t N>
void copy_text(const std::string& text, std::array<char, N>& out) {
  out = {};
  std::copy_n(text.begin(), std::min(text.size(), N - 1), out.begin());
}

class Firmware {
 public:
  explicit Firmware(const NodeIdentity& identity);

  void obey();
  // The node's last words.
  void tell_fault(const std::string& reason);

 private:
  void load();
  void render();
  void tell_time() const;

  InstructionSet instruction_set_;
  std::optional<hal::SharedMemory> film_block_;
  std::optional<Renderer> renderer_;
  std::vector<std::byte> command_;  // Load or Render and what follows it
};

Firmware::Firmware(const NodeIdentity& identity) : instruction_set_(best_instruction_set(identity.simd)) {
  Hello hello{};
  hello.node = static_cast<std::int32_t>(mynode());
  hello.machine = hal::neighbourhood().machine;
  hello.rank = hal::neighbourhood().rank;
  hello.seat = identity.seat;
  hello.memory = identity.memory;
  copy_text(identity.host, hello.host);
  copy_text(identity.binding, hello.binding);
  copy_text(name_of(instruction_set_), hello.simd);
  csend(kHello, &hello, sizeof hello, myhost(), 0);
}

void Firmware::obey() {
  for (;;) {
    led(0);
    cprobe(any_of(kLoad, kRender, kCredit, kStop, kClock));
    led(1);
    switch (infotype()) {
      case kLoad: load(); break;
      case kRender: render(); break;
      case kCredit: renderer_->outbox().receive_credit(); break;
      case kStop:
        crecv(kStop, nullptr, 0);
        if (renderer_) renderer_->finish();
        return;
      case kClock: tell_time(); break;
    }
  }
}

// The machine's first node takes the film from the host; the others read it there.
void Firmware::load() {
  command_.resize(sizeof(Load) + static_cast<std::size_t>(numnodes()) * sizeof(std::int32_t));
  crecv(kLoad, command_.data(), static_cast<long>(command_.size()));
  const auto& load = *reinterpret_cast<const Load*>(command_.data());
  const auto* machines = reinterpret_cast<const std::int32_t*>(command_.data() + sizeof(Load));
  const hal::Neighbourhood machine = hal::neighbourhood();
  film_block_.emplace(load.film_bytes);
  const auto block = film_block_->bytes();
  if (machine.index == 0) crecv(kFilmBlock, block.data(), static_cast<long>(block.size()));
  gsync();
  const FilmView film(block, "film", true);
  renderer_.emplace(film, load, std::span(machines, static_cast<std::size_t>(numnodes())), instruction_set_);
  command_.resize(sizeof(Render) + film.settings().frames * sizeof(std::uint32_t));
  csend(kLoaded, nullptr, 0, myhost(), 0);
}

void Firmware::render() {
  crecv(kRender, command_.data(), static_cast<long>(command_.size()));
  const auto& command = *reinterpret_cast<const Render*>(command_.data());
  const auto* frames = reinterpret_cast<const std::uint32_t*>(command_.data() + sizeof(Render));
  renderer_->render(command, {frames, command.frame_count});
}

void Firmware::tell_time() const {
  crecv(kClock, nullptr, 0);
  const double now = dclock();
  csend(kClock, &now, sizeof now, myhost(), 0);
}

void Firmware::tell_fault(const std::string& reason) {
  Fault fault{};
  fault.node = static_cast<std::int32_t>(mynode());
  if (renderer_) renderer_->send_trace();
  fault.frame = renderer_ ? static_cast<std::int32_t>(renderer_->frame()) : -1;
  copy_text(reason, fault.reason);
  csend(kFault, &fault, sizeof fault, myhost(), 0);
}

}  // namespace

void run_node(const NodeIdentity& identity) {
  Firmware firmware(identity);
  try {
    firmware.obey();
  } catch (const std::exception& failure) {
    firmware.tell_fault(reason_of(failure));
    crecv(kStop, nullptr, 0);  // the host ends the run; leaving first would take the reason with it
    throw;
  }
}

}  // namespace mars::node
