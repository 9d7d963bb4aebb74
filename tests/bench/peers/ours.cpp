#include "tests/bench/peers/ours.h"

#include <algorithm>
#include <iostream>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <vector>

#include "hal/nx/nx_messages.h"
#include "hal/messages/recorder.h"
#include "host/content/document/checksum.h"
#include "host/content/film/compile.h"
#include "host/content/film/frame_content.h"
#include "host/images/picture_file.h"
#include "host/render/farm/farm.h"
#include "host/render/session/session.h"
#include "host/render/sinks/frame_folder.h"
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

sinks::Manifest manifest_of(const film::CompiledFilm& film) {
  const wire::FilmSettings settings = film.view().settings();
  sinks::Manifest manifest;
  manifest.film = film.source;
  manifest.checksum = document::checksum_of(film.block());
  manifest.width = settings.width;
  manifest.height = settings.height;
  manifest.rate = settings.rate;
  manifest.film_frames = settings.frames;
  manifest.frames.resize(settings.frames);
  std::iota(manifest.frames.begin(), manifest.frames.end(), 0u);
  return manifest;
}

// Writes frames as `mars render` does. Files of earlier orders may be gone: the folder is not finished.
class FilesSink : public sinks::Sink {
 public:
  FilesSink(const film::CompiledFilm& film, const std::string& folder)
      : content_(film.view()),
        folder_(folder, manifest_of(film)),
        files_(folder_, [this](std::uint32_t frame) { return content_.checksum(frame); }) {}

  void take(compositor::Frame& frame) override { files_.take(frame); }
  bool restores() const override { return files_.restores(); }
  void check() override { files_.check(); }
  void give_up() override { files_.give_up(); }
  std::vector<std::uint32_t> read(std::uint32_t frame) const {
    return images::read_picture(folder_.format(), folder_.file_of(frame)).pixels;
  }

 private:
  const film::FrameContent content_;
  sinks::FrameFolder folder_;
  sinks::FileSink files_;
};

class Driver {
 public:
  // `files`: of course `film`.
  Driver(const wire::PackedFilm& film, Course course, const std::string& backend, FilesSink* files);

  void run(std::span<const std::byte> block);

 private:
  bool more();
  double milliseconds_a_frame() const;
  Picture last_picture();

  Course course_;
  std::string backend_;
  std::string kernels_;
  farm::PlanRequest work_;
  std::uint32_t frames_a_task_;
  wire::FilmSettings settings_;
  LastSink sink_;
  FilesSink* files_;
  std::vector<std::uint32_t> read_;  // the picture of a file
  Orders orders_;
  std::chrono::steady_clock::time_point given_;  // the order at hand
  bool begun_ = false;
  int wanted_ = 0;  // frames of the order at hand, and those left of them
  int left_ = 0;
  std::vector<farm::FinishedFrame> finished_;
};

Driver::Driver(const wire::PackedFilm& film, Course course, const std::string& backend, FilesSink* files)
    : course_(course),
      backend_(backend),
      frames_a_task_(course == Course::whole ? 1 : film.intervals()[0].frame_count),
      settings_(film.settings()),
      sink_(frames_a_task_),
      files_(files),
      orders_([this] { return last_picture(); }) {
  work_.coherence = course != Course::whole;
  work_.groups = 1;
  work_.frames.resize(settings_.frames);
  std::iota(work_.frames.begin(), work_.frames.end(), 0u);
}

Picture Driver::last_picture() {
  if (files_ == nullptr) return {settings_.width, settings_.height, sink_.pixels()};
  std::uint32_t last = 0;
  for (const farm::FinishedFrame& frame : finished_) last = std::max(last, frame.number);
  read_ = files_->read(last);
  return {settings_.width, settings_.height, read_};
}

void Driver::run(std::span<const std::byte> block) {
  farm::FarmListener listener;
  listener.booted = [this](std::span<const wire::Hello> nodes, std::uint32_t, std::uint32_t) {
    kernels_ = nodes[0].simd.data();
  };
  listener.finished = [this](const farm::FinishedFrame& frame) { finished_.push_back(frame); };
  listener.more = [this] { return more(); };
  const std::uint32_t threads = session::sink_threads(session::host_machine({}));
  const sinks::SinkPool::Shape shape{settings_.width, settings_.height, 16, threads + 2, threads};
  sinks::SinkPool pool(files_ != nullptr ? static_cast<sinks::Sink&>(*files_) : sink_, shape);
  farm::render_film(block, farm::make_plan(wire::PackedFilm(block, "film"), work_, static_cast<int>(numnodes())), {},
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
  const int asked = course_ == Course::inbetween ? wanted_ + 1 : wanted_;
  if (course_ != Course::whole && asked != static_cast<int>(frames_a_task_))
    throw std::runtime_error("an interval of this film has " + std::to_string(frames_a_task_) + " frames");
  finished_.clear();
  given_ = std::chrono::steady_clock::now();
  return true;
}

// Whole frames: from the command to the composed frame. Inbetweens: from the keyframe's arrival to the last one's. A
// film: from the order until now, when sinks have taken all frames.
double Driver::milliseconds_a_frame() const {
  if (course_ == Course::film) return milliseconds_since(given_) / wanted_;
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
  if (word == "film") return Course::film;
  if (word == "latency") return Course::latency;
  throw std::runtime_error("none of whole, inbetween, film, latency: " + word);
}

void compete(const std::string& film, Course course, const std::string& backend, const std::string& folder) {
  const film::CompiledFilm compiled = film::load_film(film);
  if (course == Course::latency) {
    std::cout << "latency " << 1000 * inbetween_latency(compiled) << std::endl;
    return;
  }
  std::optional<FilesSink> files;
  if (course == Course::film) files.emplace(compiled, folder);
  Driver(compiled.view(), course, backend, files ? &*files : nullptr).run(compiled.block());
}

}  // namespace mars::bench
