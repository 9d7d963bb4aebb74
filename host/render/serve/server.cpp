#include "host/render/serve/server.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "hal/failure/explain.h"
#include "hal/failure/failure.h"
#include "hal/messages/process.h"
#include "hal/nx/nx_messages.h"
#include "host/render/farm/farm.h"
#include "host/render/farm/film_loading.h"
#include "host/render/farm/node_inbox.h"
#include "host/render/farm/node_memory.h"
#include "host/render/pictures/socket.h"
#include "host/render/serve/drawing.h"
#include "host/render/serve/live_view.h"
#include "host/render/session/event_reporter.h"
#include "host/render/session/heartbeat_listener.h"
#include "host/render/session/status_board.h"
#include "host/render/session/termination.h"
#include "node/wire/commands.h"
#include "node/wire/film.h"
#include "node/wire/scene.h"

namespace mars::serve {
namespace {

using pictures::Kind;
using Request = pictures::Message;

constexpr std::chrono::milliseconds kRest{100};        // while nothing is asked for: as often as heartbeats look
constexpr std::chrono::milliseconds kLastWords{1000};  // that the studio has to take why the host ends
constexpr int kRequestsATurn = 64;
constexpr int kStripsATurn = 8;
constexpr std::uint64_t kViewsAShare = 4;  // of nodes' memory for stationary parts

// What the host knows of a view.
struct View {
  std::optional<Request> scene;            // asked for, and has not begun
  std::optional<Request> draw;             // the newest; of that scene, if there is one
  std::vector<std::byte> block;            // the interval's scene
  std::optional<wire::FilmView> interval;  // it, read
  wire::MovingParts moving;                // of it
  std::optional<LiveView> live;            // from its first interval on
  bool whole = false;                      // the interval's keyframe is there
  std::uint32_t newest = 0;                // of its pictures that the studio was sent: the studio's number
};

class Server {
 public:
  Server(const Serving& serving, pictures::Socket& studio, farm::Heartbeats& heartbeats);
  ~Server() { heartbeats_.ask_for_drawing({}); }
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  void shake_hands(const farm::FarmListener& listener);
  // Until the studio has closed its socket; how many pictures it got.
  std::uint32_t serve();

 private:
  bool take_requests();
  void take(Request request);
  void take_film(Request request);
  void take_scene(View& view, Request request);
  void take_draw(View& view, Request request);

  bool give_work();
  void load_film();
  bool give_scene();
  bool give_draw();
  void begin_scene(std::uint32_t number, View& view);
  void begin_draw(std::uint32_t number, View& view, int node);

  bool receive_strips();
  bool receive_one();
  void accept(farm::StripMessage strip);
  void finish(std::uint32_t number, const Picture& picture);

  void send_to_all(long type, const std::vector<std::byte>& message) const;
  void send_picture(View& view, std::uint32_t number, const Picture& picture);
  void drop(std::uint32_t view, std::uint32_t picture);
  void drop_drawn(std::uint32_t number, View& view);
  void drop_waiting(std::uint32_t number, std::optional<Request>& request);
  void drop_all(std::uint32_t number, View& view);

  const Serving& serving_;
  pictures::Socket& studio_;
  farm::Heartbeats& heartbeats_;
  farm::NodeSlots slots_;
  farm::NodeInbox inbox_;
  farm::StripStore store_;

  std::optional<Request> next_film_;  // asked for, and waits until nothing is drawn
  std::vector<std::byte> film_block_;
  std::optional<wire::FilmView> film_;  // that nodes have
  std::uint64_t still_memory_ = 0;      // of a node, for a view
  std::map<std::uint32_t, View> views_;
  Drawing drawing_;
  std::uint32_t asked_ = 0;     // the last picture: the studio's number
  std::uint32_t pictures_ = 0;  // that the studio was sent
};

Server::Server(const Serving& serving, pictures::Socket& studio, farm::Heartbeats& heartbeats)
    : serving_(serving),
      studio_(studio),
      heartbeats_(heartbeats),
      slots_(static_cast<int>(numnodes()), wire::kMaxCredits),
      inbox_(wire::kMaxSide, wire::kMaxSide, wire::PixelFormat::rgb8, slots_, nullptr),
      drawing_(static_cast<std::size_t>(numnodes())) {
  heartbeats_.ask_for_drawing([this](int node, std::int32_t) { return drawing_.drawn_by(node); });
}

void Server::shake_hands(const farm::FarmListener& listener) {
  heartbeats_.set_doing("waiting for nodes");
  inbox_.receive_hellos();
  heartbeats_.watch(inbox_.hellos());
  listener.booted(inbox_.hellos(), 0, 0);
}

std::uint32_t Server::serve() {
  heartbeats_.set_doing("waiting for the studio");
  while (studio_.is_open()) {
    heartbeats_.look();
    bool worked = take_requests();
    worked |= give_work();
    worked |= receive_strips();
    studio_.flush();
    if (worked) continue;
    if (drawing_.all_idle())
      studio_.wait(kRest);
    else
      flick();
  }
  heartbeats_.forget_nodes();
  send_to_all(wire::kStop, {});
  return pictures_;
}

bool Server::take_requests() {
  int taken = 0;
  for (; taken < kRequestsATurn; ++taken) {
    std::optional<Request> request = studio_.receive();
    if (!request) break;
    take(std::move(*request));
  }
  return taken > 0;
}

void Server::take(Request request) {
  const std::uint32_t number = request.head.view;
  if (request.head.kind == Kind::view || request.head.kind == Kind::draw) {
    if (request.head.picture <= asked_)
      throw pictures::Malformed(pictures::Sender::studio, "pictures whose numbers do not ascend");
    asked_ = request.head.picture;
  }
  switch (request.head.kind) {
    case Kind::film: return take_film(std::move(request));
    case Kind::view: return take_scene(views_[number], std::move(request));
    case Kind::draw:
      if (const auto view = views_.find(number); view != views_.end())
        return take_draw(view->second, std::move(request));
      return drop(number, request.head.picture);
    default:
      if (const auto view = views_.find(number); view != views_.end()) {
        drop_all(number, view->second);
        if (view->second.live) send_to_all(wire::kCloseView, pictures::joined(wire::CloseView{number}));
        views_.erase(view);
      }
  }
}

void Server::take_film(Request request) {
  for (auto& [number, view] : views_) drop_all(number, view);
  views_.clear();
  next_film_ = std::move(request);
}

void Server::take_scene(View& view, Request request) {
  drop_all(request.head.view, view);
  view.scene = std::move(request);
}

void Server::take_draw(View& view, Request request) {
  drop_waiting(request.head.view, view.draw);
  view.draw = std::move(request);
}

// Whether there was something to give.
bool Server::give_work() {
  if (!next_film_) return film_ && (give_scene() || give_draw());
  if (!drawing_.all_idle()) return false;
  load_film();
  return true;
}

void Server::load_film() {
  film_block_ = std::exchange(next_film_, std::nullopt)->body;
  film_.emplace(film_block_, "the studio's film");
  const std::uint64_t bytes = std::ranges::min(inbox_.hellos(), {}, &wire::Hello::memory).memory;
  const farm::NodeMemory memory = farm::share_node_memory(bytes, std::nullopt, film_->settings());
  still_memory_ = memory.still / kViewsAShare;
  wire::Load load{};
  load.memory = memory.frames;
  load.still_memory = memory.still;
  load.credits = wire::kMaxCredits;
  load.mapping = serving_.mapping;
  load.groups = 1;
  load.pixel_format = wire::PixelFormat::rgb8;
  load.live = 1;
  heartbeats_.set_doing("loading");
  farm::load_film(film_block_, load, inbox_);
  slots_.give_all();
  heartbeats_.set_doing("waiting for the studio");
  const wire::FilmSettings& settings = film_->settings();
  const pictures::Begin begin{settings.width, settings.height, serving_.block, 1, 0, 0};
  studio_.send({Kind::begin}, pictures::body_of_begin(begin, inbox_.hellos()));
}

// The scene that has waited longest, unless nodes draw a keyframe of another view. One of the same view goes to them at
// once, to end the one before; nodes have no more than these two.
bool Server::give_scene() {
  auto next = views_.end();
  for (auto view = views_.begin(); view != views_.end(); ++view) {
    if (!view->second.scene) continue;
    const Drawing::Keyframes drawn = drawing_.keyframes(view->first);
    if (drawn.others > 0 || drawn.of_view > 1) continue;
    if (next == views_.end() || view->second.scene->head.picture < next->second.scene->head.picture) next = view;
  }
  if (next == views_.end()) return false;
  begin_scene(next->first, next->second);
  return true;
}

void Server::begin_scene(std::uint32_t number, View& view) {
  const Request request = std::exchange(view.scene, std::nullopt).value();
  view.block = request.body;
  view.interval.emplace(view.block, *film_, "the scene of view " + std::to_string(number));
  const wire::FilmView& scene = *view.interval;
  const wire::FilmSettings& settings = scene.settings();
  if (!view.live || !view.live->has_size(settings.width, settings.height))
    view.live.emplace(settings.width, settings.height, serving_.block);
  const wire::Interval& interval = scene.intervals().front();
  view.moving = wire::MovingParts(scene);
  view.live->begin_interval(farm::background_pixel(scene, interval, wire::PixelFormat::rgb8), view.moving.are_all());
  view.whole = false;

  Picture picture{number, request.head.picture, wire::FrameKind::keyframe, view.live->begin_picture()};
  picture.begun = dclock();
  const std::uint32_t wired = drawing_.next_number();
  const std::uint64_t still = settings.samples > 1 ? still_memory_ : 0;
  send_to_all(wire::kView, pictures::joined(wire::View{number, wired, view.block.size(), still}, view.block));
  drawing_.give_to_all(wired, picture);
}

// The inbetween that has waited longest, if a node is idle.
bool Server::give_draw() {
  auto next = views_.end();
  for (auto view = views_.begin(); view != views_.end(); ++view) {
    if (!view->second.draw || view->second.scene || !view->second.whole) continue;
    if (next == views_.end() || view->second.draw->head.picture < next->second.draw->head.picture) next = view;
  }
  if (next == views_.end()) return false;
  const std::optional<int> node = drawing_.take_idle();
  if (node) begin_draw(next->first, next->second, *node);
  return node.has_value();
}

void Server::begin_draw(std::uint32_t number, View& view, int node) {
  const Request request = std::exchange(view.draw, std::nullopt).value();
  Picture picture{number, request.head.picture, wire::FrameKind::inbetween, view.live->begin_picture()};
  picture.begun = dclock();
  const std::uint32_t wired = drawing_.next_number();
  pictures::DrawHead head;
  std::memcpy(&head, request.body.data(), sizeof head);
  const std::vector<std::byte> message = pictures::joined(wire::Draw{number, wired, head.segments, head.patches},
                                                          std::span(request.body).subspan(sizeof head));
  wire::read_draw(message, [&](std::uint32_t) { return &view.moving; });
  csend(wire::kDraw, message.data(), static_cast<long>(message.size()), node, 0);
  drawing_.give(node, wired, picture);
}

bool Server::receive_strips() {
  int received = 0;
  while (received < kStripsATurn && receive_one()) ++received;
  return received > 0;
}

// Whether something came.
bool Server::receive_one() {
  auto strip = inbox_.finished_strip();
  if (!strip && iprobe(wire::any_of(wire::kStrip, wire::kFault)) == 0) return false;
  if (!strip && infotype() == wire::kFault) inbox_.receive_fault();
  if (!strip) strip = inbox_.receive_strip(store_);
  if (strip) accept(std::move(*strip));
  return true;
}

void Server::accept(farm::StripMessage strip) {
  const wire::Strip header = strip.header();
  heartbeats_.hear(header);
  Picture* picture = drawing_.find(header.node, header.frame);
  if (picture == nullptr || picture->view != header.interval || picture->kind != header.kind)
    inbox_.refuse(header.node, "a strip of picture " + std::to_string(header.frame) + " that it was not asked for");
  if (header.cut == 1 && picture->frame != nullptr)
    inbox_.refuse(header.node, "a part of picture " + std::to_string(header.frame) + " without its lines");
  if (picture->frame != nullptr) views_.at(picture->view).live->paste(strip, *picture->frame);
  slots_.give(strip.slot());
  store_.give_back(strip.release());
  if (header.last == 0) return;
  if (const std::optional<Picture> whole = drawing_.end(header.node, header.frame)) finish(header.frame, *whole);
}

// All strips came. Where a newer one was quicker, it is needed no more.
void Server::finish(std::uint32_t number, const Picture& picture) {
  if (picture.frame == nullptr) return;
  View& view = views_.at(picture.view);
  if (picture.kind == wire::FrameKind::keyframe) view.whole = true;
  if (picture.asked > view.newest) return send_picture(view, number, picture);
  view.live->give_up(picture.frame);
  drop(picture.view, picture.asked);
}

void Server::send_picture(View& view, std::uint32_t number, const Picture& picture) {
  pictures::Picture shown = view.live->finish(picture.frame, number);
  shown.head.kind = picture.kind;
  shown.head.seconds = dclock() - picture.begun;
  view.newest = picture.asked;
  ++pictures_;
  studio_.send({Kind::picture, picture.view, picture.asked}, body_of_picture(shown));
}

void Server::send_to_all(long type, const std::vector<std::byte>& message) const {
  for (long node = 0; node < numnodes(); ++node)
    csend(type, message.data(), static_cast<long>(message.size()), node, 0);
}

void Server::drop(std::uint32_t view, std::uint32_t picture) { studio_.send({Kind::dropped, view, picture}); }

void Server::drop_waiting(std::uint32_t number, std::optional<Request>& request) {
  if (request) drop(number, request->head.picture);
  request.reset();
}

// Nodes may still draw it; what they send is pasted nowhere.
void Server::drop_drawn(std::uint32_t number, View& view) {
  drawing_.for_wanted(number, [&](Picture& picture) {
    view.live->give_up(std::exchange(picture.frame, nullptr));
    drop(number, picture.asked);
  });
}

void Server::drop_all(std::uint32_t number, View& view) {
  drop_drawn(number, view);
  drop_waiting(number, view.scene);
  drop_waiting(number, view.draw);
}

events::Fault fault_of(const std::exception& reason) {
  const Failure failure = explain(reason);
  events::Fault fault{failure.problem, failure.where, failure.remedy, {}, {}, ""};
  if (const auto* at_node = dynamic_cast<const farm::NodeFailure*>(&reason)) fault.node = at_node->node;
  return fault;
}

// Its last message.
void send_refusal(pictures::Socket& studio, const std::string& text) {
  studio.send({Kind::refused}, pictures::body_of(text));
  const auto last = std::chrono::steady_clock::now() + kLastWords;
  studio.drain([last] { return std::chrono::steady_clock::now() >= last; });
}

child::Descriptor connect_to_studio(const std::string& path) {
  child::Descriptor descriptor = pictures::connect_to(path);
  if (descriptor.open()) return descriptor;
  throw Failure(std::string("no studio answers: ") + std::strerror(errno), path,
                "the host of a studio runs on its machine");
}

}  // namespace

void serve(const Serving& serving) {
  session::StatusBoard board("the studio's");
  session::EventReporter reporter(serving.backend, board);
  std::optional<pictures::Socket> studio;
  try {
    session::Termination termination(true);
    farm::Heartbeats heartbeats(session::host_name(), getpid(), heartbeat_listener(reporter, termination));
    studio.emplace(connect_to_studio(serving.socket), pictures::Peer::studio);
    Server server(serving, *studio, heartbeats);
    server.shake_hands(reporter.listener(0));
    const double begun = dclock();
    const std::uint32_t pictures = server.serve();
    reporter.report(events::Done{pictures, dclock() - begun, ""});
  } catch (const std::exception& reason) {
    reporter.report(fault_of(reason));
    if (studio) send_refusal(*studio, reason_of(reason));
    throw;
  }
}

}  // namespace mars::serve
