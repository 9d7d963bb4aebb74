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
class LastSink : public sinks::Sink {
 public:
  explicit LastSink(std::uint32_t stride) : stride_(stride) {}

  void take(compositor::Frame& frame) override {
    if (frame.number % stride_ == stride_ - 1) pixels_ = frame.pixels;
  }
  const std::vector<std::uint32_t>& pixels() const { return pixels_; }

 private:
  std::uint32_t stride_;
  std::vector<std::uint32_t> pixels_;
};

class Driver {
 public:
  Driver(const wire::FilmView& film, Course course, const std::string& backend);

  void run(std::span<const std::byte> block);

 private:
  bool more();
  double milliseconds_a_frame() const;

  Course course_;
  std::string backend_;
  std::string kernels_;
  farm::PlanRequest work_;
  std::uint32_t frames_a_task_;
  wire::FilmSettings settings_;
  LastSink sink_;
  Orders orders_;
  bool begun_ = false;
  int wanted_ = 0;  // frames of the order at hand, and those left of them
  int left_ = 0;
  std::vector<farm::FinishedFrame> finished_;
};

Driver::Driver(const wire::FilmView& film, Course course, const std::string& backend)
    : course_(course),
      backend_(backend),
      frames_a_task_(course == Course::whole ? 1 : film.intervals()[0].frame_count),
      settings_(film.settings()),
      sink_(frames_a_task_),
      orders_([this] {
        return Picture{settings_.width, settings_.height, sink_.pixels()};
      }) {
  work_.coherence = course == Course::inbetween;
  work_.groups = 1;
  work_.frames.resize(settings_.frames);
  std::iota(work_.frames.begin(), work_.frames.end(), 0u);
}

void Driver::run(std::span<const std::byte> block) {
  farm::FarmListener listener;
  listener.booted = [this](std::span<const wire::Hello> nodes, std::uint32_t, std::uint32_t) {
    kernels_ = nodes[0].simd.data();
  };
  listener.finished = [this](const farm::FinishedFrame& frame) { finished_.push_back(frame); };
  listener.more = [this] { return more(); };
  sinks::SinkPool pool(sink_, {settings_.width, settings_.height, 16, 4, 2});
  farm::render_film(block, farm::make_plan(wire::FilmView(block, "film"), work_, static_cast<int>(numnodes())), {},
                    pool, listener);
  if (begun_ && left_ > 0) throw std::runtime_error("the film has fewer frames than the orders ask for");
}

bool Driver::more() {
  if (!begun_)
    orders_.send_ready("MARS, " + backend_ + " backend, nodes: " + std::to_string(numnodes()) + ", " + kernels_);
  else if (--left_ == 0)
    orders_.send_milliseconds(milliseconds_a_frame());
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
  for (const farm::FinishedFrame& frame : finished_) {
    whole += frame.seconds - frame.given;
    last = std::max(last, frame.seconds);
    if (frame.kind == wire::FrameKind::keyframe) keyframe = frame.seconds;
  }
  return 1000 * (course_ == Course::whole ? whole : last - keyframe) / wanted_;
}

// Whether an event is a step of drawing a frame on a node, or of receiving and composing it on the host; which frame.
std::optional<std::uint32_t> frame_of_step(const trace::Trace::Record& record, int host) {
  const messages::Event& event = record.event;
  if (event.kind != messages::Event::Kind::span) return {};
  if (record.rank != host) {
    if (event.what >= static_cast<std::int32_t>(wire::Phase::credit)) return {};
    return static_cast<std::uint32_t>(event.frame);
  }
  const auto what = static_cast<trace::HostSpan>(event.what);
  if (what != trace::HostSpan::strip && what != trace::HostSpan::compose) return {};
  return static_cast<std::uint32_t>(event.value);
}

// Seconds; the middle one of the first interval's inbetweens.
double inbetween_latency(const film::CompiledFilm& film) {
  const wire::FilmSettings settings = film.view().settings();
  const wire::Interval interval = film.view().intervals()[0];
  sinks::NullSink sink;
  sinks::SinkPool pool(sink, {settings.width, settings.height, 16, 4, 2});
  trace::Trace trace;
  farm::FarmOptions options;
  options.trace = &trace;
  farm::PlanRequest work{std::vector<std::uint32_t>(interval.frame_count)};
  std::iota(work.frames.begin(), work.frames.end(), interval.first_frame);
  const farm::Plan plan = farm::make_plan(film.view(), work, static_cast<int>(numnodes()));
  farm::render_film(film.block(), plan, options, pool, {});
  std::vector<double> seconds(interval.frame_count);
  for (const trace::Trace::Record& record : trace.records())
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
  const film::CompiledFilm compiled = film::load_film(film);
  if (course == Course::latency)
    std::cout << "latency " << 1000 * inbetween_latency(compiled) << std::endl;
  else
    Driver(compiled.view(), course, backend).run(compiled.block());
}

}  // namespace mars::bench
