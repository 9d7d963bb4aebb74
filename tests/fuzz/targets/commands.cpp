// The host's commands as a node checks them: the input says which, and how a sound one is changed.
#include <cstring>
#include <memory>

#include "hal/collectives/group.h"
#include "hal/failure/failure.h"
#include "node/geometry/scene.h"
#include "node/wire/commands.h"
#include "node/wire/greeting.h"
#include "node/wire/scene.h"
#include "tests/fuzz/edits.h"
#include "tests/fuzz/target.h"
#include "tests/node/wire/small_film.h"

namespace mars::fuzz::commands {
namespace {

constexpr int kNodes = 5, kGroups = 2, kNode = 3;
constexpr std::size_t kLongest = 1 << 14;

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
  render.teams = 2;
  render.goes_on = goes_on ? 1 : 0;
  Message message = message_of(render);
  if (render.listed == 1) append(message, {0, 1});
  if (render.cycle != 0) append(message, {1, 0});
  return message;
}

Message sound_view() {
  const Message block = wire::pack_scene(wire::small_scene());
  Message message = message_of(wire::BeginView{1, 2, block.size(), 0, 0});
  message.insert(message.end(), block.begin(), block.end());
  return message;
}

Message sound_draw() {
  Message message = message_of(wire::Draw{1, 3, 1, 2});
  for (const Message& part :
       {message_of(wire::MovedSegment{1, 1, wire::moved(3)}), message_of(wire::MovedPatch{0, 0, wire::flat_patch()}),
        message_of(wire::MovedPatch{1, 0, wire::flat_patch()})})
    message.insert(message.end(), part.begin(), part.end());
  return message;
}

// Changed, at an address of its own to the last byte, aligned as the node's buffers are.
std::unique_ptr<std::byte[]> exact(const Message& message) {
  auto bytes = std::make_unique<std::byte[]>(message.size());
  if (!message.empty()) std::memcpy(bytes.get(), message.data(), message.size());
  return bytes;
}

const wire::PackedFilm& film() {
  static const Message block = wire::pack(wire::small_film());
  static const wire::PackedFilm view(block, "film");
  return view;
}

void read_load(std::span<const std::byte> message) {
  const wire::LoadCommand command = wire::read_load(message, kNodes, "n3 (node 3)");
  check(command.machines.size() == kNodes && command.machines[kNode] <= kNode, "machines are nodes before");
}

void read_render(std::span<const std::byte> message) {
  static const std::vector<std::uint32_t> left{1};
  std::vector<std::uint32_t> frames;
  const wire::RenderCommand command = wire::read_render(message, film(), {kNode, kNodes, kGroups, left}, frames);
  for (const std::uint32_t frame : command.frames) check(frame < film().settings().frames, "frames are the film's");
  for (std::size_t k = 0; k < command.inbetweens().size(); ++k) {
    const collectives::Group group = command.group(), team = command.team(k);
    check(team.count > 0 && team.first >= group.first && team.first + team.count <= group.first + group.count,
          "teams are the group's");
  }
}

// The scene as nodes read it, who copy its block.
void read_begin_view(std::span<const std::byte> message) {
  const wire::BeginViewCommand command = wire::read_begin_view(message);
  const Message block(command.scene.begin(), command.scene.end());
  const wire::PackedFilm view(block, film(), "scene");
  const wire::MovingParts moving(view);
  geometry::Scene scene(view);
  scene.set_interval(0);
  scene.set_frame(0);
  for (std::uint32_t s = 0; s < view.segments().size(); ++s) {
    const std::uint32_t shape = view.segments()[s].shape;
    const bool changes = view.segments()[s].bone_count > 0 ? !scene.stands(s) : true;
    check(!moving.has_segment(s) || (scene.moves(s) && changes), "of what may be changed all moves");
    check(scene.material(s) < moving.materials(), "segments are the scene's");
    for (std::size_t piece = 0; piece < view.shape(shape).size(); ++piece)
      check(scene.moves(s) || !scene.moves(s, piece), "pieces move with their segments");
    check(view.patches_of(shape).size() + view.meshlets_of(shape).size() == view.shape(shape).size(),
          "shapes are whole");
    for (const wire::Patch& patch : view.patches_of(shape)) check(wire::sound(patch), "patches are sound");
    scene.matrix(s);
  }
}

void read_draw(std::span<const std::byte> message) {
  static const Message block = wire::pack_scene(wire::small_scene());
  static const wire::PackedFilm view(block, film(), "scene");
  static const wire::MovingParts moving(view);
  const wire::DrawCommand command =
      wire::read_draw(message, [](std::uint32_t number) { return number == 1 ? &moving : nullptr; });
  for (const wire::MovedSegment& moved : command.segments)
    check(moved.segment == 1 && moved.material < 2 && wire::sound(moved.matrix), "the second segment moves");
  for (const wire::MovedPatch& moved : command.patches)
    check(moved.patch < 2 && wire::sound(moved.points), "the first patches move");
}

}  // namespace

void take(std::string_view input) {
  static const Message sound[] = {sound_load(),
                                  message_of(wire::Credit{1, 0}),
                                  message_of(wire::Beat{{"n0"}}),
                                  sound_render(false, false),
                                  sound_render(true, false),
                                  sound_render(false, true),
                                  sound_render(true, true),
                                  sound_view(),
                                  sound_draw(),
                                  message_of(wire::CloseView{1})};
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
    case 7: return read_begin_view(message);
    case 8: return read_draw(message);
    case 9: check(wire::read_close_view(message).view < wire::kMostViews, "a view is one of few"); return;
    default: read_render(message);
  }
}

const Target target("commands", Form::bytes, take);

}  // namespace mars::fuzz::commands
