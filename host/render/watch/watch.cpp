#include "host/render/watch/watch.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

namespace mars::watch {
using pictures::Kind;
using pictures::Part;

namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr auto kRest = 20ms;              // between pictures: nobody sees more of them
constexpr auto kLook = 500ms;             // for a watcher
constexpr auto kLongestEnd = 1s;          // of what is left for the watcher
constexpr std::size_t kMostDrawn = 1024;  // messages that wait

// Its pixels as they are shown, with their marks.
const pictures::Picture& shown(PictureUpdate& update, const Display& display) {
  std::vector<std::uint32_t>& pixels = update.picture.pixels;
  const std::vector<std::uint32_t> words = std::exchange(pixels, std::vector<std::uint32_t>(update.marks.size()));
  display.show(words, pixels.data());
  for (std::size_t i = 0; i < pixels.size(); ++i) pixels[i] |= static_cast<std::uint32_t>(update.marks[i]) << 24;
  return update.picture;
}

}  // namespace

Watch::Watch(const std::string& socket) : name_(socket) { absent_ = connect(); }

Watch::~Watch() {
  {
    const std::lock_guard lock(mutex_);
    last_ = Clock::now() + kLongestEnd;
  }
  changed_.notify_one();
  if (thread_.joinable()) thread_.join();
}

void Watch::begin(const Shape& shape, std::span<const wire::Hello> nodes) {
  shape_.emplace(shape);
  display_.emplace(shape_->film, shape.format);
  const wire::FilmSettings& film = shape.film.settings();
  begin_ = pictures::body_of_begin({film.width, film.height, shape.block, shape.groups, shape.frames, 0}, nodes);
  picture_.emplace(film.width, film.height, shape.block, shape.format);
  thread_ = std::thread([this] { work(); });
}

void Watch::receive(const wire::Strip& header, double seconds) {
  const std::lock_guard lock(mutex_);
  auto& [parts, load_ratio] = under_way_[header.frame];
  load_ratio = header.load_ratio;
  auto part = std::ranges::find(parts, header.node, &Part::node);
  if (part == parts.end())
    part = parts.insert(part, {header.node, header.first_line, header.last_line, 0, 0, {}, 0, 0, 0});
  part->first_line = std::min(part->first_line, header.first_line);
  part->last_line = std::max(part->last_line, header.last_line);
  ++part->strips;
  part->ended = seconds;
  part->times = header.times;
  part->triangles = header.work.triangles;
  part->edge_boxes = header.work.edge_boxes;
  part->pixels = header.work.pixels;
}

void Watch::follow(std::uint32_t group) {
  const std::lock_guard lock(mutex_);
  if (picture_->group() != group) picture_->follow(group);
}

void Watch::paste(std::uint32_t group, const PastedStrip& strip, const compositor::Compositor& compositor,
                  const compositor::Frame& frame, double seconds) {
  const std::lock_guard lock(mutex_);
  if (group != picture_->group()) return;
  picture_->paste(strip, compositor, frame, seconds);
  if (picture_->has_news()) changed_.notify_one();
}

void Watch::compose(const WholeFrame& frame) {
  const std::lock_guard lock(mutex_);
  note_drawn(frame);
  if (frame.group == picture_->group())
    picture_->finish(frame.picture, frame.interval, frame.kind, frame.first_node, frame.seconds);
  changed_.notify_one();
}

void Watch::note_drawn(const WholeFrame& frame) {
  const Drawn drawn = std::move(under_way_[frame.picture.number]);
  under_way_.erase(frame.picture.number);
  const pictures::DrawnHead head{.frame = frame.picture.number,
                                 .interval = frame.interval,
                                 .kind = frame.kind,
                                 .group = frame.group,
                                 .parts = static_cast<std::uint32_t>(drawn.parts.size()),
                                 .given = frame.given,
                                 .seconds = frame.seconds,
                                 .load_ratio = drawn.load_ratio};
  if (drawn_.size() == kMostDrawn) drawn_.pop_front();
  drawn_.push_back(pictures::body_of(head, drawn.parts));
}

// Where it fails, for want of memory, the rendering goes on unwatched.
void Watch::work() try {
  do {
    look_for_watcher();
    if (has_watcher()) send(take_news());
  } while (wait_for_news());
} catch (const std::exception&) {
}

void Watch::look_for_watcher() {
  if (has_watcher()) socket_->look();
  if (!has_watcher()) connect();
}

std::string Watch::connect() {
  child::Descriptor descriptor = pictures::connect_to(name_);
  if (!descriptor.open()) return std::strerror(errno);
  socket_.emplace(std::move(descriptor), pictures::Peer::watcher);
  is_new_ = true;
  return "";
}

Watch::News Watch::take_news() {
  News news;
  const std::lock_guard lock(mutex_);
  news.begins = std::exchange(is_new_, false);
  if (news.begins) picture_->forget_sent();
  news.drawn = std::exchange(drawn_, {});
  if (!picture_->has_news()) return news;
  // What is shown otherwise is sent whole.
  if (display_->begin_frame(picture_->frame())) picture_->forget_sent();
  news.picture = picture_->take();
  return news;
}

void Watch::send(News news) {
  if (news.begins) socket_->send({Kind::begin}, begin_);
  for (pictures::Body& drawn : news.drawn) socket_->send({Kind::drawn}, std::move(drawn));
  if (news.picture) socket_->send({Kind::picture}, body_of_picture(shown(*news.picture, *display_)));
  socket_->drain([this] {
    const std::lock_guard lock(mutex_);
    return last_ && Clock::now() > *last_;
  });
}

// Whether it goes on: until the run has ended and what is left is sent.
bool Watch::wait_for_news() {
  std::unique_lock lock(mutex_);
  if (!last_) changed_.wait_for(lock, kRest, [this] { return last_.has_value(); });
  changed_.wait_for(lock, kLook, [this] { return last_ || (has_watcher() && has_news()); });
  return !last_ || (has_watcher() && has_news() && Clock::now() < *last_);
}

}  // namespace mars::watch
