#include "node/live_views.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "hal/nx/nx_messages.h"

namespace mars::node {
namespace {

std::vector<std::uint64_t> words_of(std::span<const std::byte> bytes) {
  std::vector<std::uint64_t> words((bytes.size() + sizeof(std::uint64_t) - 1) / sizeof(std::uint64_t));
  if (!bytes.empty()) std::memcpy(words.data(), bytes.data(), bytes.size());
  return words;
}

// Whether pictures of one take the same memory as those of the other, with depths of the same kind.
bool are_alike(const wire::PackedFilm& a, const wire::PackedFilm& b) {
  const wire::FilmSettings &one = a.settings(), &other = b.settings();
  return one.width == other.width && one.height == other.height && one.samples == other.samples &&
         a.camera_at(0).projection == b.camera_at(0).projection && a.casting_count() == b.casting_count() &&
         a.patch_instances() == b.patch_instances();
}

}  // namespace

LiveViews::LiveScene::LiveScene(std::span<const std::byte> block, const wire::PackedFilm& base)
    : block_(words_of(block)),
      film_(std::as_bytes(std::span(block_)).first(block.size()), base, "scene"),
      moving_(film_) {}

void LiveViews::LiveScene::put(std::span<const wire::MovedPatch> patches) {
  for (auto before = replaced_.rbegin(); before != replaced_.rend(); ++before) patch(before->patch) = before->points;
  replaced_.clear();
  for (const wire::MovedPatch& moved : patches) {
    replaced_.push_back({moved.patch, 0, patch(moved.patch)});
    patch(moved.patch) = moved.points;
  }
}

wire::Patch& LiveViews::LiveScene::patch(std::uint32_t number) {
  const auto at = std::as_bytes(film_.patches().subspan(number)).data() - std::as_bytes(std::span(block_)).data();
  return *reinterpret_cast<wire::Patch*>(std::as_writable_bytes(std::span(block_)).data() + at);
}

LiveViews::LiveViews(const wire::PackedFilm& film, simd::InstructionSet set, Renderer& renderer, HasEnded has_ended)
    : film_(film), instruction_set_(set), renderer_(renderer), has_ended_(std::move(has_ended)) {}

void LiveViews::begin(std::span<const std::byte> begin_command) {
  const wire::BeginViewCommand command = wire::read_begin_view(begin_command);
  LiveView& live = put_scene(command);
  Canvas& canvas = live.canvas;
  canvas.scene.set_interval(0);
  canvas.scene.set_frame(0);
  std::ranges::fill(canvas.contributes, std::uint8_t{1});
  const wire::MovingParts& moving = live.scene.moving();
  const std::uint32_t picture = command.view.picture;
  if (moving.are_all())
    canvas.still.begin_moving_interval(picture);
  else
    canvas.still.begin_interval(picture, {0, moving.are_none() ? 0 : live.scene.film().settings().height});
  const collectives::Group group = renderer_.neighbours().group();
  draw_picture(live, {wire::FrameKind::keyframe, picture, command.view.view, group, group.count});
}

// What is of the pictures' size stays where the size does.
LiveViews::LiveView& LiveViews::put_scene(const wire::BeginViewCommand& command) {
  const std::uint32_t number = command.view.view;
  const Canvas::Memory memory{command.view.still_memory, command.view.shadow_memory};
  LiveScene scene(command.scene, film_);
  const auto known = views_.find(number);
  if (known != views_.end() && known->second.memory == memory && are_alike(known->second.scene.film(), scene.film())) {
    known->second.canvas.scene = geometry::Scene(scene.film());
    known->second.scene = std::move(scene);
    return known->second;
  }
  if (known != views_.end()) views_.erase(known);
  Canvas canvas(scene.film(), renderer_.neighbours(), memory, instruction_set_);
  return views_.emplace(number, LiveView{std::move(scene), memory, std::move(canvas)}).first->second;
}

void LiveViews::draw(std::span<const std::byte> draw_command) {
  const wire::DrawCommand command = wire::read_draw(draw_command, [this](std::uint32_t view) {
    const auto known = views_.find(view);
    return known == views_.end() ? nullptr : &known->second.scene.moving();
  });
  if (renderer_.outbox().stopped()) return;
  LiveView& live = views_.at(command.draw.view);
  live.scene.put(command.patches);
  live.canvas.scene.move(command.segments);
  const auto self = static_cast<int>(mynode());
  draw_picture(live, {wire::FrameKind::inbetween, command.draw.picture, command.draw.view, {self, 1}, 1});
}

void LiveViews::draw_picture(LiveView& live, const Frame& frame) {
  renderer_.draw(live.canvas, frame, [&] { return has_ended_(frame.interval); });
}

void LiveViews::close(std::span<const std::byte> close_command) {
  views_.erase(wire::read_close_view(close_command).view);
}

}  // namespace mars::node
