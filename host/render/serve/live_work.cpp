#include "host/render/serve/live_work.h"

#include <chrono>
#include <cstring>
#include <span>
#include <string>
#include <utility>

#include "hal/nx/nx_messages.h"
#include "host/render/farm/node_memory.h"
#include "node/wire/commands.h"

namespace mars::serve {
namespace {

constexpr std::chrono::milliseconds kRest{100};  // while nothing is requested: as often as heartbeats look
constexpr int kRequestsATurn = 64;
constexpr std::uint64_t kViewsAShare = 4;  // of nodes' memory for stationary parts

}  // namespace

using pictures::Kind;

bool LiveWork::give_work() {
  const bool taken = take_requests();
  return give() || taken;
}

// While nothing is drawn the host sleeps.
void LiveWork::rest() { engine_.assignments().all_idle() ? studio_.wait(kRest) : WorkGiver::rest(); }

bool LiveWork::take_requests() {
  int taken = 0;
  for (; taken < kRequestsATurn; ++taken) {
    std::optional<Request> request = studio_.receive();
    if (!request) break;
    take(std::move(*request));
  }
  return taken > 0;
}

void LiveWork::take(Request request) {
  const std::uint32_t number = request.head.view;
  if (request.head.kind == Kind::scene || request.head.kind == Kind::draw) {
    if (request.head.picture <= requested_)
      throw pictures::Malformed(pictures::Sender::studio, "pictures whose numbers do not ascend");
    requested_ = request.head.picture;
  }
  switch (request.head.kind) {
    case Kind::film: return take_film(std::move(request));
    case Kind::scene:
      drop_all(number, views_[number]);
      views_[number].scene = std::move(request);
      return;
    case Kind::draw:
      if (!views_.contains(number)) return pictures_.send_dropped(number, request.head.picture);
      drop_waiting(number, views_[number].draw);
      views_[number].draw = std::move(request);
      return;
    default: close(number);
  }
}

void LiveWork::take_film(Request request) {
  for (auto& [number, view] : views_) {
    drop_all(number, view);
    pictures_.forget(number);
  }
  views_.clear();
  next_film_ = std::move(request);
}

void LiveWork::close(std::uint32_t number) {
  const auto view = views_.find(number);
  if (view == views_.end()) return;
  drop_all(number, view->second);
  if (pictures_.is_known(number))
    farm::Engine::send(engine_.all(), wire::kCloseView, pictures::joined(wire::CloseView{number}));
  pictures_.forget(number);
  views_.erase(view);
}

void LiveWork::drop_waiting(std::uint32_t number, std::optional<Request>& request) {
  if (request) pictures_.send_dropped(number, request->head.picture);
  request.reset();
}

void LiveWork::drop_all(std::uint32_t number, View& view) {
  pictures_.drop(number);
  drop_waiting(number, view.scene);
  drop_waiting(number, view.draw);
}

bool LiveWork::give() {
  if (!next_film_) return film_ && (give_scene() || give_draw());
  if (!engine_.assignments().all_idle()) return false;
  load_film();
  return true;
}

void LiveWork::load_film() {
  film_block_ = std::exchange(next_film_, std::nullopt)->body;
  film_.emplace(film_block_, "the studio's film");
  const wire::FilmSettings& settings = film_->settings();
  shadow::ShadowNeeds shadows = shadow::shadow_needs(*film_);
  shadows.casting = std::max(shadows.casting, 1u);
  const std::uint64_t bytes = engine_.node_memory();
  const farm::NodeMemory memory = farm::share_node_memory(bytes, {}, settings, shadows);
  still_memory_ = memory.still / kViewsAShare;
  shadow_memory_ = memory.shadows / kViewsAShare;
  wire::Load load{};
  load.mapping = mapping_;
  load.groups = 1;
  load.memory = bytes - memory.still - std::min(memory.shadows, bytes / 2);
  load.still_memory = memory.still;
  load.live = 1;
  engine_.load_film(film_block_, load);
  engine_.set_doing("waiting for the studio");
  const pictures::Begin begin{settings.width, settings.height, block_, 1, 0, 0};
  studio_.send({Kind::begin}, pictures::body_of_begin(begin, engine_.inbox().hellos()));
}

// The scene that has waited longest, unless nodes draw a keyframe of another view. One of the same view goes to them at
// once, to end the one before; nodes have no more than these two.
bool LiveWork::give_scene() {
  auto next = views_.end();
  for (auto view = views_.begin(); view != views_.end(); ++view) {
    if (!view->second.scene || !pictures_.takes_keyframe(view->first)) continue;
    if (next == views_.end() || view->second.scene->head.picture < next->second.scene->head.picture) next = view;
  }
  if (next == views_.end()) return false;
  begin_scene(next->first, next->second);
  return true;
}

void LiveWork::begin_scene(std::uint32_t number, View& view) {
  const Request request = std::exchange(view.scene, std::nullopt).value();
  view.block = request.body;
  view.interval.emplace(view.block, *film_, "the scene of view " + std::to_string(number));
  view.moving = wire::MovingParts(*view.interval);
  const std::uint32_t picture =
      pictures_.begin_keyframe(number, request.head.picture, *view.interval, view.moving.are_all());
  const bool has_groups = view.interval->settings().samples > 1 || view.interval->casting_count() > 0;
  const std::uint64_t still = has_groups ? still_memory_ : 0;
  farm::Engine::send(
      engine_.all(), wire::kBeginView,
      pictures::joined(wire::BeginView{number, picture, view.block.size(), still, shadow_memory_}, view.block));
}

// The inbetween that has waited longest, if a node is idle.
bool LiveWork::give_draw() {
  auto next = views_.end();
  for (auto view = views_.begin(); view != views_.end(); ++view) {
    if (!view->second.draw || view->second.scene || !pictures_.has_keyframe(view->first)) continue;
    if (next == views_.end() || view->second.draw->head.picture < next->second.draw->head.picture) next = view;
  }
  if (next == views_.end()) return false;
  const std::optional<int> node = engine_.assignments().idle_from(turn_);
  if (!node) return false;
  turn_ = static_cast<std::size_t>(*node) + 1;
  begin_draw(next->first, next->second, *node);
  return true;
}

void LiveWork::begin_draw(std::uint32_t number, View& view, int node) {
  const Request request = std::exchange(view.draw, std::nullopt).value();
  const std::uint32_t picture = pictures_.begin_inbetween(number, request.head.picture, node);
  pictures::DrawHead head;
  std::memcpy(&head, request.body.data(), sizeof head);
  const std::vector<std::byte> message = pictures::joined(wire::Draw{number, picture, head.segments, head.patches},
                                                          std::span(request.body).subspan(sizeof head));
  wire::read_draw(message, [&](std::uint32_t) { return &view.moving; });
  farm::Engine::send({node, 1}, wire::kDraw, message);
}

}  // namespace mars::serve
