#include "tests/bench/peers/ours.h"

#include <algorithm>
#include <iostream>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <vector>

#include "hal/nx/nx_messages.h"
#include "hal/messages/recorder.h"
#include "host/render/farm/farm.h"
#include "host/content/film/compile.h"
#include "host/render/trace/trace.h"
#include "tests/bench/peers/peer.h"

namespace mars::bench {
namespace {

// Keeps the last frame of every `stride`: those in between are seen by nobody.
class LastSink : public host::Sink {
 public:
  explicit LastSink(std::uint32_t stride) : stride_(stride) {}

  void take(const host::Frame& frame) override {
    if (frame.number % stride_ == stride_ - 1) pixels_ = frame.pixels;
  }
  const std::vector<std::uint32_t>& pixels() const { return pixels_; }

 private:
  std::uint32_t stride_;
  std::vector<std::uint32_t> pixels_;
};

class Driver {
 public:
  Driver(const node::FilmView& film, Course course, const std::string& backend);

  void run(std::span<const std::byte> block);

 private:
  bool more();
  double milliseconds_a_frame() const;

  Course course_;
  std::string backend_;
  std::string kernels_;
  host::PlanRequest work_;
  std::uint32_t frames_a_task_;
  node::FilmSettings settings_;
  LastSink sink_;
  Orders orders_;
  bool begun_ = false;
  int wanted_ = 0;  // frames of the order at hand, and those left of them
  int left_ = 0;
  std::vector<host::FinishedFrame> finished_;
};

Driver::Driver(const node::FilmView& film, Course course, const std::string& backend)
    : course_(course),
      backend_(backend),
      frames_a_task_(course == Course::whole ? 1 : film.intervals()[0].frame_count),
      settings_(film.settings()),
      sink_(frames_a_task_),
      orders_([this] { return Picture{settings_.width, settings_.height, sink_.pixels()}; }) {
  work_.coherence = course == Course::inbetween;
  work_.groups = 1;
  work_.frames.resize(settings_.frames);
  std::iota(work_.frames.begin(), work_.frames.end(), 0u);
}

void Driver::run(std::span<const std::byte> block) {
  host::FarmListener listener;
  listener.booted = [this](std::span<const node::Hello> nodes, std::uint32_t, std::uint32_t) {
    kernels_ = nodes[0].simd.data();
  };
  listener.finished = [this](const host::FinishedFrame& frame) { finished_.push_back(frame); };
  listener.more = [this] { return more(); };
  host::SinkPool pool(sink_, {settings_.width, settings_.height, 16, 4, 2});
  host::render_film(block, make_plan(node::FilmView(block, "film"), work_, static_cast<int>(numnodes())), {}, pool, listener);
  if (begun_ && left_ > 0) throw std::runtime_error("the film has too few frames for so many orders");
}

bool Driver::more() {
  if (!begun_)
    orders_.tell_ready("MARS, " + backend_ + " backend, nodes: " + std::to_string(numnodes()) + ", " + kernels_);
  else if (--left_ == 0)
    orders_.tell_milliseconds(milliseconds_a_frame());
  begun_ = true;
  if (left_ > 0) return true;
  const auto go = orders_.next_go();
  if (!go) return false;
  wanted_ = *go;
  left_ = course_ == Course::whole ? wanted_ : 1;
  if (course_ == Course::inbetween && wanted_ + 1 != static_cast<int>(frames_a_task_))
    throw std::runtime_error("an interval of this film has " + std::to_string(frames_a_task_ - 1) + " inbetweens");
  finished_.clear();
  return true;
}

// Whole frames: from the command to the composed frame. Inbetweens: from the keyframe's arrival to the last one's.
double Driver::milliseconds_a_frame() const {
  double whole = 0, keyframe = 0, last = 0;
  for (const host::FinishedFrame& frame : finished_) {
    whole += frame.seconds - frame.given;
    last = std::max(last, frame.seconds);
    if (frame.kind == node::FrameKind::keyframe) keyframe = frame.seconds;
  }
  return 1000 * (course_ == Course::whole ? whole : last - keyframe) / wanted_;
}

// Whether an event is a step of drawing a frame on a node, or of receiving and composing it on the host; which frame.
std::optional<std::uint32_t> frame_of_step(const host::Trace::Record& record, int host) {
  const hal::Event& event = record.event;
  if (event.kind != hal::Event::Kind::span) return {};
  if (record.rank != host) {
    if (event.what >= static_cast<std::int32_t>(node::Phase::credit)) return {};
    return static_cast<std::uint32_t>(event.frame);
  }
  const auto what = static_cast<host::HostSpan>(event.what);
  if (what != host::HostSpan::strip && what != host::HostSpan::compose) return {};
  return static_cast<std::uint32_t>(event.value);
}

// Seconds; the middle one of the first interval's inbetweens.
double inbetween_latency(const host::CompiledFilm& film) {
  const node::FilmSettings settings = film.view().settings();
  const node::Interval interval = film.view().intervals()[0];
  host::NullSink sink;
  host::SinkPool pool(sink, {settings.width, settings.height, 16, 4, 2});
  host::Trace trace;
  host::FarmOptions options;
  options.trace = &trace;
  host::PlanRequest work{std::vector<std::uint32_t>(interval.frame_count)};
  std::iota(work.frames.begin(), work.frames.end(), interval.first_frame);
  const host::Plan plan = host::make_plan(film.view(), work, static_cast<int>(numnodes()));
  host::render_film(film.block(), plan, options, pool, {});
  std::vector<double> seconds(interval.frame_count);
  for (const host::Trace::Record& record : trace.records())
    if (const auto frame = frame_of_step(record, trace.host()))
      seconds.at(*frame - interval.first_frame) += record.event.end - record.event.begin;
  const auto middle = seconds.begin() + static_cast<std::ptrdiff_t>(seconds.size() / 2);
  std::nth_element(seconds.begin() + 1, middle, seconds.end());
  return *middle;
}

}  // namespace

Course course_of(const std::string& word) {
  if (word == "whole") return Course::whole;
  if (word == "inbetween") return Course::inbetween;
  if (word == "latency") return Course::latency;
  throw std::runtime_error("none of whole, inbetween, latency: " + word);
}

void compete(const std::string& film, Course course, const std::string& backend) {
  const host::CompiledFilm compiled = host::load_film(film);
  if (course == Course::latency)
    std::cout << "latency " << 1000 * inbetween_latency(compiled) << std::endl;
  else
    Driver(compiled.view(), course, backend).run(compiled.block());
}

}  // namespace mars::bench
