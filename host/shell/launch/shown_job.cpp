#include "host/shell/launch/shown_job.h"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <optional>
#include <thread>

#include "host/child/child.h"
#include "host/shell/launch/background_text.h"
#include "host/shell/launch/job.h"
#include "host/shell/launch/prepared_text.h"
#include "host/shell/launch/seen_folder.h"

namespace mars::launch {
namespace {

constexpr std::chrono::seconds kSlowStart{20};  // of waiting for nodes, until a person learns that none has answered
constexpr std::chrono::milliseconds kFolderLook{50};

// The machines in the order of ranks; none where ranks are more than slots: they go round over the machines then.
std::vector<Slots> by_rank(const options::RenderOptions& options, const std::vector<Slots>& machines) {
  std::uint64_t slots = 0;
  for (const Slots& each : machines) slots += each.count;
  return options.nodes < slots ? machines : std::vector<Slots>();
}

bool has_others(const std::vector<Slots>& machines) { return !std::ranges::all_of(machines, is_here, &Slots::host); }

// A scheduler that MARS does not know may place the host without a word.
std::string host_of(const std::vector<Slots>& machines) {
  return machines.empty() ? "another machine" : machines.front().host;
}

// Waits until it is known, after a job that ended well.
bool is_missed(SeenFolder& folder) {
  for (; folder.is_open(); std::this_thread::sleep_for(kFolderLook)) folder.look_for_frames(SeenFolder::Clock::now());
  return folder.is_missed();
}

Failure no_frames_for_videos(const std::string& machine, const options::RenderOptions& options) {
  return Failure("the host writes frames into this folder on " + machine +
                     ", and this machine, which makes videos of them, does not see them",
                 options.folder, "put the folder or the video where all machines see it, or start this there");
}

// Finds reasons while no node answers, and prints them as soon as they are known.
class SlowStart {
 public:
  SlowStart(const options::RenderOptions& options, bool with_others, Display& display, const Adviser& adviser)
      : options_(options), display_(display), adviser_(adviser) {
    if (with_others) machines_.emplace([&] { return adviser.about_machines(options); });
  }

  void begin() {
    display_.print("no node has answered for " + std::to_string(kSlowStart.count()) + " seconds");
    hint_.begin([ask = adviser_.while_it_starts, options = options_] { return ask(options); });
    if (machines_) machines_->begin();
  }

  void look() {
    if (const std::string text = hint_.take(); !text.empty()) display_.print(text);
    const auto found = machines_ ? machines_->take() : std::nullopt;
    if (!found) return;
    cut_off_ = found->substr(0, found->find('\n'));
    display_.print(found->substr(std::min(cut_off_.size() + 1, found->size())));
  }

  // Which machines do not reach each other; "": all do, or that is not known.
  const std::string& cut_off() const { return cut_off_; }

 private:
  const options::RenderOptions& options_;
  Display& display_;
  const Adviser& adviser_;
  BackgroundText hint_;
  std::optional<PreparedText> machines_;
  std::string cut_off_;
};

}  // namespace

std::string elsewhere_text(const std::string& folder, const std::string& machine) {
  return "the folder " + folder + " is on " + machine + ", and this machine does not see it";
}

Remains show_job(const options::RenderOptions& options, const Starting& starting, const std::vector<Slots>& machines,
                 Display& display, const Adviser& adviser) {
  const std::vector<Slots> used = machines.empty() ? machines_of(options, starting) : machines;
  const child::Command command = command_for(options, starting, machines);
  display.print(shell_text(command));
  SlowStart slow(options, has_others(used), display, adviser);
  SeenFolder folder(options.folder);
  Job job(display);
  const auto look = [&] {
    slow.look();
    if (folder.look(job.remains().run, SeenFolder::Clock::now()) && options.videos.empty())
      display.print("warning: " + elsewhere_text(options.folder, host_of(used)));
  };
  job.follow(command, {kSlowStart, [&](child::Child&) { slow.begin(); }, look,
                       [&] { return folder.is_missed() && !options.videos.empty(); }});
  display.settle();
  Remains remains = job.remains();
  remains.cut_off = slow.cut_off();
  if (!remains.booted && remains.passed_on == 0) remains.machines = by_rank(options, used);
  if (remains.well() ? is_missed(folder) : folder.is_missed()) remains.elsewhere = host_of(used);
  if (!remains.elsewhere.empty() && !options.videos.empty() && remains.passed_on == 0)
    throw no_frames_for_videos(remains.elsewhere, options);
  return remains;
}

}  // namespace mars::launch
