#include "host/render/watch/watch.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace mars::watch {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr auto kRest = 20ms;              // between pictures: nobody sees more of them
constexpr auto kLook = 500ms;             // for a watcher
constexpr auto kLongestEnd = 1s;          // of what is left for the watcher
constexpr std::size_t kMostDrawn = 1024;  // messages that wait

template <typename T>
void append(std::vector<std::byte>& to, std::span<const T> items) {
  const auto bytes = std::as_bytes(items);
  to.insert(to.end(), bytes.begin(), bytes.end());
}

template <typename T>
void append(std::vector<std::byte>& to, const T& item) {
  append(to, std::span(&item, 1));
}

template <typename Body, typename Item>
std::vector<std::byte> message_of(Kind kind, const Body& body, std::span<const Item> items) {
  std::vector<std::byte> message;
  append(message, Head{kind, 0, sizeof body + items.size_bytes()});
  append(message, body);
  append(message, items);
  return message;
}

std::vector<Node> nodes_of(std::span<const wire::Hello> hellos) {
  std::vector<Node> nodes;
  for (const wire::Hello& hello : hellos) nodes.push_back({hello.machine, hello.host});
  return nodes;
}

std::vector<std::byte> picture_message(PictureUpdate& update, const Display& display) {
  const std::size_t pixel_words = update.marks.empty() ? 1 : update.words.size() / update.marks.size();
  if (pixel_words == 2) {
    std::vector<std::uint32_t> shown(update.marks.size());
    display.show(update.words, shown.data());
    update.words = std::move(shown);
  } else {
    display.show(update.words, update.words.data());
  }
  for (std::size_t i = 0; i < update.words.size(); ++i)
    update.words[i] |= static_cast<std::uint32_t>(update.marks[i]) << 24;
  std::vector<std::byte> message;
  const std::span<const Rect> rects(update.rects);
  const std::span<const Line> lines(update.lines);
  const std::span<const std::uint32_t> pixels(update.words);
  message.reserve(sizeof(Head) + sizeof update.head + rects.size_bytes() + lines.size_bytes() + pixels.size_bytes());
  append(message, Head{Kind::picture, 0, message.capacity() - sizeof(Head)});
  append(message, update.head);
  append(message, rects);
  append(message, lines);
  append(message, pixels);
  return message;
}

}  // namespace

Watch::Watch(const std::string& socket) : link_(socket) {
  absent_ = link_.connect();
  is_new_ = absent_.empty();
}

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
  const std::vector<Node> named = nodes_of(nodes);
  const Begin begin{film.width,   film.height,  shape.block,
                    shape.groups, shape.frames, static_cast<std::uint32_t>(named.size())};
  begin_ = message_of(Kind::begin, begin, std::span<const Node>(named));
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
  const DrawnHead head{.frame = frame.picture.number,
                       .interval = frame.interval,
                       .kind = frame.kind,
                       .group = frame.group,
                       .parts = static_cast<std::uint32_t>(drawn.parts.size()),
                       .given = frame.given,
                       .seconds = frame.seconds,
                       .load_ratio = drawn.load_ratio};
  if (drawn_.size() == kMostDrawn) drawn_.pop_front();
  drawn_.push_back(message_of(Kind::drawn, head, std::span<const Part>(drawn.parts)));
}

// Where it fails, for want of memory, the rendering goes on unwatched.
void Watch::work() try {
  do {
    look_for_watcher();
    if (link_.connected()) send(take_news());
  } while (wait_for_news());
} catch (const std::exception&) {
}

void Watch::look_for_watcher() {
  link_.look();
  if (!link_.connected() && link_.connect().empty()) is_new_ = true;
}

Watch::News Watch::take_news() {
  News news;
  const std::lock_guard lock(mutex_);
  if (std::exchange(is_new_, false)) {
    news.messages = begin_;
    picture_->forget_sent();
  }
  for (const std::vector<std::byte>& message : drawn_)
    news.messages.insert(news.messages.end(), message.begin(), message.end());
  drawn_.clear();
  if (!picture_->has_news()) return news;
  // What is shown otherwise is sent whole.
  if (display_->begin_frame(picture_->frame())) picture_->forget_sent();
  picture_->take(news.picture.emplace());
  return news;
}

void Watch::send(News news) {
  const auto is_late = [this] {
    const std::lock_guard lock(mutex_);
    return last_ && Clock::now() > *last_;
  };
  link_.send(news.messages, is_late);
  if (news.picture) link_.send(picture_message(*news.picture, *display_), is_late);
}

// Whether it goes on: until the run has ended and what is left is sent.
bool Watch::wait_for_news() {
  std::unique_lock lock(mutex_);
  if (!last_) changed_.wait_for(lock, kRest, [this] { return last_.has_value(); });
  changed_.wait_for(lock, kLook, [this] { return last_ || (link_.connected() && has_news()); });
  return !last_ || (link_.connected() && has_news() && Clock::now() < *last_);
}

}  // namespace mars::watch
