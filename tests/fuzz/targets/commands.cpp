// The host's commands as a node checks them: the input says which, and how a sound one is changed.
#include <cstring>
#include <memory>

#include "hal/collectives/group.h"
#include "hal/failure/failure.h"
#include "node/wire/commands.h"
#include "node/wire/greeting.h"
#include "tests/fuzz/edits.h"
#include "tests/fuzz/target.h"
#include "tests/node/wire/small_film.h"

namespace mars::fuzz {
namespace {

constexpr int kNodes = 5, kGroups = 2, kNode = 3;
constexpr std::size_t kLongest = 4096;

void append(Message& message, std::initializer_list<std::uint32_t> words) {
  for (const std::uint32_t word : words) {
    const Message bytes = message_of(word);
    message.insert(message.end(), bytes.begin(), bytes.end());
  }
}

Message sound_load() {
  wire::Load load{};
  load.stamp = wire::own_stamp();
  load.film_bytes = 4096;
  load.credits = wire::kMaxCredits;
  load.groups = kGroups;
  Message message = message_of(load);
  append(message, {0, 0, 2, 2, 4});
  return message;
}

// The second goes on with what the first has left.
Message sound_render(bool listed, bool goes_on) {
  const collectives::Group group = collectives::group_of(kNodes, kGroups, 1);
  wire::Render render{};
  render.group_first = group.first;
  render.group_count = group.count;
  render.contributors = 2;
  render.frame_count = goes_on ? 1 : 2;
  render.first_frame = goes_on ? 1 : 0;
  render.drawn = render.frame_count;
  render.listed = listed && !goes_on ? 1 : 0;
  render.cycle = listed ? 2 : 0;
  render.goes_on = goes_on ? 1 : 0;
  Message message = message_of(render);
  if (render.listed == 1) append(message, {0, 1});
  if (render.cycle != 0) append(message, {1, 0});
  return message;
}

// Changed, at an address of its own to the last byte, aligned as the node's buffers are.
std::unique_ptr<std::byte[]> exact(const Message& message) {
  auto bytes = std::make_unique<std::byte[]>(message.size());
  if (!message.empty()) std::memcpy(bytes.get(), message.data(), message.size());
  return bytes;
}

void read_load(std::span<const std::byte> message) {
  const wire::LoadCommand command = wire::read_load(message, kNodes, "n3 (node 3)");
  check(command.machines.size() == kNodes && command.machines[kNode] <= kNode, "machines are nodes before");
}

void read_render(std::span<const std::byte> message) {
  static const Message block = wire::pack(wire::small_film());
  static const wire::FilmView film(block, "film");
  static const std::vector<std::uint32_t> left{1};
  std::vector<std::uint32_t> frames;
  const wire::RenderCommand command = wire::read_render(message, film, {kNode, kNodes, kGroups, left}, frames);
  for (const std::uint32_t frame : command.frames) check(frame < film.settings().frames, "frames are the film's");
  for (const std::int32_t member : command.cycle)
    check(member >= 0 && member < command.render.group_count, "the cycle's nodes are the group's");
}

}  // namespace

const Form kForm = Form::bytes;

void take(std::string_view input) {
  static const Message sound[] = {sound_load(),
                                  message_of(wire::Credit{1, 0}),
                                  message_of(wire::Beat{{"n0"}}),
                                  sound_render(false, false),
                                  sound_render(true, false),
                                  sound_render(false, true),
                                  sound_render(true, true)};
  Script script(input);
  const std::size_t which = script.below(std::size(sound));
  Message changed = sound[which];
  while (!script.at_end()) edit(changed, script, kLongest);
  const auto bytes = exact(changed);
  const std::span<const std::byte> message(bytes.get(), changed.size());
  switch (which) {
    case 0: return read_load(message);
    case 1: check(wire::read_credit(message, 1, 4).slot < 4, "a slot is one of the node's"); return;
    case 2: check(wire::read_beat(message).host.back() == '\0', "a machine's name ends"); return;
    default: read_render(message);
  }
}

}  // namespace mars::fuzz
