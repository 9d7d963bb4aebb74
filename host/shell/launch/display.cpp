#include "host/shell/launch/display.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <cmath>

#include "hal/failure/plain_text.h"
#include "host/content/document/text.h"

namespace mars::launch {

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kTerminalPeriod{100};
constexpr std::chrono::milliseconds kLinePeriod{2000};
constexpr const char* kClearLine = "\r\x1b[K";

std::string one_decimal(double value) { return document::formatted("%.1f", value); }

// Simulated films may take milliseconds.
std::string seconds_text(double seconds) {
  return seconds < 1 ? document::formatted("%.2g", seconds) : one_decimal(seconds);
}

// A line that wraps could not be written over.
std::string fitting(const std::string& text) {
  winsize size{};
  if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return text;
  return text.substr(0, size.ws_col - 1u);
}

// Nothing where no other time could be shown.
std::string between_text(const events::Progress::Left& left) {
  if (!left.between) return "";
  const std::string low = clock_text(left.between->front()), high = clock_text(left.between->back());
  return low == high ? "" : ", 90 %: " + low + " to " + high;
}

std::string left_text(const events::Progress& progress) {
  const auto left = progress.left();
  if (!left) return "";
  std::string text = ", " + clock_text(left->seconds()) + " left" + between_text(*left);
  if (progress.keyframes.of == 0 || progress.inbetweens.of == 0) return text;
  return text + " (keyframes " + clock_text(left->keyframes) + ", inbetweens " + clock_text(left->inbetweens) + ")";
}

}  // namespace

std::string clock_text(double seconds) {
  const auto whole = static_cast<unsigned long>(std::lround(std::min(seconds, 1e9)));
  if (whole >= 3600) return document::formatted("%lu:%02lu:%02lu", whole / 3600, whole / 60 % 60, whole % 60);
  return document::formatted("%lu:%02lu", whole / 60, whole % 60);
}

std::string progress_text(const events::Progress& progress) {
  std::string text = "frame " + std::to_string(progress.done()) + " of " + std::to_string(progress.of());
  if (progress.done() == 0) return text + left_text(progress);
  text += ", interval " + std::to_string(progress.interval + 1) + " of " + std::to_string(progress.intervals);
  if (progress.seconds() > 0) text += ", " + one_decimal(progress.done() / progress.seconds()) + " frames/s";
  return text + left_text(progress);
}

std::string progress_line(const events::Progress& progress) {
  const std::uint64_t percent = progress.of() > 0 ? std::uint64_t{100} * progress.done() / progress.of() : 0;
  return "Progress: " + std::to_string(percent) + "%, " + progress_text(progress);
}

std::string resumed_text(const events::Resumed& resumed) {
  const bool all = resumed.there == resumed.of;
  if (resumed.there == 0 && !resumed.changed.empty()) return resumed.changed;
  const std::string changed = resumed.changed.empty() ? "" : resumed.changed + "\n";
  return changed + std::to_string(resumed.there) + " of " + document::counted(resumed.of, "frame") +
         (resumed.of == 1 ? " is" : " are") + " there already" + (all ? ": nothing is left to render" : "");
}

std::string booted_text(const events::Booted& booted) {
  std::string text = document::counted(booted.nodes.size(), "node") + " on " +
                     document::counted(booted.machines, "machine") + " (" + booted.backend + ")";
  std::string simd;
  for (const events::Booted::Node& node : booted.nodes) {
    if (simd.find(node.simd) == std::string::npos) simd += (simd.empty() ? "" : ", ") + node.simd;
  }
  return text + ", " + simd;
}

std::string done_text(const events::Done& done) {
  std::string text = document::counted(done.frames, "frame");
  if (!done.folder.empty()) text += " in " + done.folder;
  text += ", " + seconds_text(done.seconds) + " seconds";
  if (done.seconds > 0) text += ", " + one_decimal(done.frames / done.seconds) + " frames/s";
  if (done.trace_lacks > 0)
    text += "\nthe trace was full: it lacks " + document::counted(done.trace_lacks, "later event");
  return text;
}

void Display::print(const std::string& line) {
  if (kind_ == Kind::silent) return;
  if (line_open_) out_ << kClearLine;
  line_open_ = false;
  out_ << plain_text(line) << std::endl;
}

void Display::show(const events::Progress& progress) {
  if (kind_ == Kind::silent || !due()) return;
  if (kind_ == Kind::lines) {
    if (progress.done() > shown_) out_ << progress_line(progress) << std::endl;
    shown_ = progress.done();
    return;
  }
  out_ << kClearLine << fitting(progress_text(progress)) << std::flush;
  line_open_ = true;
}

void Display::show(const std::string& line) {
  if (kind_ == Kind::silent || !due()) return;
  if (kind_ == Kind::lines) {
    out_ << plain_text(line) << std::endl;
    return;
  }
  out_ << kClearLine << fitting(plain_text(line)) << std::flush;
  line_open_ = true;
}

void Display::settle() {
  if (line_open_) out_ << std::endl;
  line_open_ = false;
  shown_ = 0;
}

bool Display::due() {
  const Clock::time_point now = Clock::now();
  if (now - last_ < (kind_ == Kind::terminal ? kTerminalPeriod : kLinePeriod)) return false;
  last_ = now;
  return true;
}

Display::Kind kind_of_output(bool quiet) {
  if (quiet) return Display::Kind::silent;
  return isatty(STDOUT_FILENO) ? Display::Kind::terminal : Display::Kind::lines;
}

}  // namespace mars::launch
