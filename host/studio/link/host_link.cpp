#include "host/studio/link/host_link.h"

#include <algorithm>
#include <array>
#include <boost/asio/io_context.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <chrono>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "hal/failure/explain.h"
#include "host/studio/link/host_connection.h"
#include "host/studio/link/host_job.h"
#include "host/studio/link/host_process.h"

namespace mars::studio {
namespace {

namespace asio = boost::asio;
using Clock = std::chrono::steady_clock;
using pictures::Kind;

// Before a host that ended is started again: the next each time, until one lived long enough.
constexpr std::array<std::chrono::seconds, 5> kPauses{{std::chrono::seconds(1), std::chrono::seconds(2),
                                                       std::chrono::seconds(4), std::chrono::seconds(8),
                                                       std::chrono::seconds(15)}};
constexpr std::chrono::seconds kLongEnough{30};
constexpr std::chrono::seconds kGrace{2};  // of a host whose studio has closed the socket

class HostLink : public RendererLink {
 public:
  HostLink(asio::io_context& context, HostStart start, Listener listener);

  void set_film(std::shared_ptr<const std::vector<std::byte>> block) override;
  void begin(std::uint32_t view, std::uint32_t picture, std::vector<std::byte> scene_block) override;
  void draw(std::uint32_t view, std::uint32_t picture, std::span<const wire::MovedSegment> segments,
            std::span<const wire::MovedPatch> patches) override;
  void close(std::uint32_t view) override { forget(view, true); }

 private:
  // What was asked for last, and is asked for again where the host died.
  struct Asked {
    std::uint32_t picture = 0;
    pictures::Body body;  // nullptr: nothing
  };
  struct View {
    Asked scene;
    Asked draw;                       // of this scene
    std::set<std::uint32_t> awaited;  // pictures without an answer
  };

  void start();
  void connected();
  void ready(const std::vector<pictures::Node>& nodes);
  void take(SurfacePicture picture);
  void dropped(std::uint32_t view, std::uint32_t picture);
  void closed(const std::string& reason);
  void job_ended(const std::string& reason);
  void give_up_awaited();
  void start_later(const std::string& reason);

  void ask(std::uint32_t view, Kind kind, const Asked& asked);
  void forget(std::uint32_t view, bool and_tell_the_host);
  void drop_replaced(std::uint32_t view, bool scenes);
  void drop_soon(std::uint32_t view, std::uint32_t picture);
  // `act`, from the io_context, as long as the link lives.
  template <typename Act>
  void soon(Act act) {
    asio::post(context_, [alive = std::weak_ptr(alive_), act] {
      if (!alive.expired()) act();
    });
  }

  asio::io_context& context_;
  const HostStart start_;
  const Listener listener_;
  std::shared_ptr<const std::vector<std::byte>> film_;  // nullptr: none yet
  std::map<std::uint32_t, View> views_;

  std::shared_ptr<bool> alive_ = std::make_shared<bool>(true);
  asio::steady_timer pause_;
  std::size_t pauses_ = 0;  // since a host lived long enough
  std::optional<Clock::time_point> ready_since_;
  std::optional<HostProcess> job_;
  std::optional<HostConnection> connection_;  // closed before the job is waited for
  bool connected_ = false;
  std::string why_closed_;  // "": the host closed it
};

HostLink::HostLink(asio::io_context& context, HostStart start, Listener listener)
    : context_(context), start_(std::move(start)), listener_(std::move(listener)), pause_(context) {
  soon([this] { listener_.state("the renderer starts"); });
  this->start();
}

void HostLink::start() try {
  connected_ = false;
  why_closed_.clear();
  ready_since_.reset();
  connection_.emplace(
      context_, HostConnection::Listener{.connected = [this] { connected(); },
                                         .begin = [this](const pictures::BeginMessage& begin) { ready(begin.nodes); },
                                         .picture = [this](SurfacePicture picture) { take(std::move(picture)); },
                                         .dropped = [this](auto view, auto picture) { dropped(view, picture); },
                                         .drawn = {},
                                         .closed = [this](const std::string& reason) { closed(reason); }});
  const child::Command command = host_command(start_, connection_->path());
  job_.emplace(
      context_, [&](const child::ProcessSetup& setup) { return start_host_job(command, start_.options, setup); },
      kGrace,
      HostProcess::Listener{.warned = [](const std::string&) {},
                            .ended = [this](const child::Ending&, const std::string& reason) { job_ended(reason); }});
} catch (const std::exception& failure) {
  start_later(reason_of(failure));
}

void HostLink::connected() {
  connected_ = true;
  connection_->close_to_others();
  if (film_) connection_->send(Kind::film, 0, 0, film_);
  struct Again {
    std::uint32_t view;
    Kind kind;
    Asked asked;
  };
  std::vector<Again> again;
  for (const auto& [number, view] : views_) {
    again.push_back({number, Kind::scene, view.scene});
    if (view.draw.body) again.push_back({number, Kind::draw, view.draw});
  }
  std::ranges::sort(again, {}, [](const Again& each) { return each.asked.picture; });
  for (const Again& each : again) ask(each.view, each.kind, each.asked);
}

void HostLink::ask(std::uint32_t view, Kind kind, const Asked& asked) {
  views_.at(view).awaited.insert(asked.picture);
  if (connected_) connection_->send(kind, view, asked.picture, asked.body);
}

void HostLink::ready(const std::vector<pictures::Node>& nodes) {
  ready_since_ = Clock::now();
  std::set<std::int32_t> machines;
  for (const pictures::Node& node : nodes) machines.insert(node.machine);
  listener_.state("");
  listener_.ready(static_cast<std::uint32_t>(nodes.size()), static_cast<std::uint32_t>(machines.size()));
}

void HostLink::take(SurfacePicture picture) {
  const auto view = views_.find(picture.view);
  if (view == views_.end()) return;
  view->second.awaited.erase(picture.picture);
  listener_.picture(std::move(picture));
}

void HostLink::dropped(std::uint32_t view, std::uint32_t picture) {
  const auto found = views_.find(view);
  if (found != views_.end() && found->second.awaited.erase(picture) > 0) listener_.dropped(view, picture);
}

void HostLink::drop_soon(std::uint32_t view, std::uint32_t picture) {
  soon([this, view, picture] { listener_.dropped(view, picture); });
}

// What the host has not been sent yet, or, where there is none, all that was asked for.
void HostLink::drop_replaced(std::uint32_t view, bool scenes) {
  View& of = views_.at(view);
  std::vector<std::uint32_t> replaced;
  if (connected_)
    replaced = connection_->take_back(view, scenes);
  else
    std::ranges::copy_if(of.awaited, std::back_inserter(replaced),
                         [&](std::uint32_t picture) { return scenes || picture != of.scene.picture; });
  for (const std::uint32_t picture : replaced)
    if (of.awaited.erase(picture) > 0) drop_soon(view, picture);
}

void HostLink::set_film(std::shared_ptr<const std::vector<std::byte>> block) {
  while (!views_.empty()) forget(views_.begin()->first, false);
  film_ = std::move(block);
  if (connected_) connection_->send(Kind::film, 0, 0, film_);
}

void HostLink::begin(std::uint32_t view, std::uint32_t picture, std::vector<std::byte> scene_block) {
  View& of = views_[view];
  drop_replaced(view, true);
  of.scene = {picture, std::make_shared<const std::vector<std::byte>>(std::move(scene_block))};
  of.draw = {};
  ask(view, Kind::scene, of.scene);
}

void HostLink::draw(std::uint32_t view, std::uint32_t picture, std::span<const wire::MovedSegment> segments,
                    std::span<const wire::MovedPatch> patches) {
  const auto found = views_.find(view);
  if (found == views_.end()) return drop_soon(view, picture);
  drop_replaced(view, false);
  const pictures::DrawHead head{static_cast<std::uint32_t>(segments.size()),
                                static_cast<std::uint32_t>(patches.size())};
  found->second.draw = {picture, pictures::body_of(head, segments, patches)};
  ask(view, Kind::draw, found->second.draw);
}

void HostLink::forget(std::uint32_t view, bool and_tell_the_host) {
  const auto found = views_.find(view);
  if (found == views_.end()) return;
  drop_replaced(view, true);
  for (const std::uint32_t picture : found->second.awaited) drop_soon(view, picture);
  views_.erase(found);
  if (connected_ && and_tell_the_host) connection_->send(Kind::close, view, 0, nullptr);
}

void HostLink::closed(const std::string& reason) {
  connected_ = false;
  why_closed_ = reason;
}

// `job_`, which calls this, stays until there is a new one.
void HostLink::job_ended(const std::string& reason) {
  if (ready_since_ && Clock::now() - *ready_since_ >= kLongEnough) pauses_ = 0;
  connected_ = false;
  connection_.reset();
  give_up_awaited();
  start_later(why_closed_.empty() ? reason : why_closed_);
}

// All but what is asked for again.
void HostLink::give_up_awaited() {
  for (auto& [number, view] : views_)
    for (const std::uint32_t picture : std::exchange(view.awaited, {}))
      if (picture == view.scene.picture || picture == view.draw.picture)
        view.awaited.insert(picture);
      else
        drop_soon(number, picture);
}

void HostLink::start_later(const std::string& reason) {
  const std::chrono::seconds pause = kPauses[std::min(pauses_++, kPauses.size() - 1)];
  soon([this, pause, why = reason.empty() ? "it ended" : reason] {
    listener_.state("the renderer starts again in " + std::to_string(pause.count()) + " s: " + why);
  });
  pause_.expires_after(pause);
  pause_.async_wait([this, alive = std::weak_ptr(alive_)](auto error) {
    if (!error && !alive.expired()) start();
  });
}

}  // namespace

std::unique_ptr<RendererLink> make_host_link(asio::io_context& context, const options::RenderOptions& options,
                                             const std::filesystem::path& self, RendererLink::Listener listener) {
  return std::make_unique<HostLink>(context, prepare_host(options, self), std::move(listener));
}

}  // namespace mars::studio
