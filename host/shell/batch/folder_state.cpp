#include "host/shell/batch/folder_state.h"

#include <time.h>

#include <algorithm>

#include "hal/failure/failure.h"
#include "host/child/child.h"
#include "host/content/document/text.h"
#include "host/render/sinks/frame_folder.h"
#include "host/shell/batch/remembered_jobs.h"
#include "host/shell/launch/display.h"

namespace mars::batch {

namespace fs = std::filesystem;

namespace {

constexpr std::int64_t kLate = 15;   // seconds; a status is written every 2
constexpr std::int64_t kLost = 60;   // seconds; then its claim ends, too
constexpr double kNamedSilence = 5;  // seconds
constexpr double kSlow = 1.25;       // times as long as usual
constexpr double kLeastHours = 0.1;  // below it is a number of seconds

std::vector<FolderState::Run> runs_in(const fs::path& folder) {
  std::vector<FolderState::Run> runs;
  const sinks::ProcessName self = sinks::this_process();
  for (const sinks::RunFiles& run : sinks::RunsFolder(folder, self).runs()) {
    std::optional<sinks::Claim> claim = sinks::claim_of(run);
    if (!claim) continue;
    const bool ended = sinks::is_running(claim->process, self) == sinks::Running::no;
    std::optional<sinks::Status> status = sinks::status_of(run);
    const std::int64_t silent = time(nullptr) - (status ? status->written : claim->since);
    runs.push_back({std::move(*claim), ended, silent, std::move(status)});
  }
  return runs;
}

void count_frames(FolderState& state, const fs::path& folder) {
  const sinks::Manifest manifest = sinks::read_manifest(folder);
  state.film = manifest.film;
  state.used = manifest.usage;
  for (const FolderState::Run& run : state.runs)
    if (run.status) state.used += run.status->used;
  state.of = static_cast<std::uint32_t>(manifest.frames.size());
  state.there = static_cast<std::uint32_t>(manifest.frames.size() -
                                           sinks::missing_frames(folder, manifest, manifest.frames).size());
}

// A cluster whose controller does not answer hides no frames.
void find_jobs(FolderState& state, const std::vector<Jobs>& jobs) {
  try {
    state.jobs = queued_jobs(jobs);
  } catch (const child::Stopped&) {
    throw;
  } catch (const Failure& failure) {
    state.no_jobs = failure.problem;
  }
}

std::string folder_line(const FolderState& state) {
  if (state.film.empty()) return state.folder + ": no frame yet";
  return state.folder + ": " + std::to_string(state.there) + " of " + document::counted(state.of, "frame") + " of " +
         state.film + (state.complete() ? ", complete" : "");
}

std::string progress_of(const sinks::Status& status) {
  std::string text = status.doing.empty() || status.of > 0 ? "" : status.doing;
  if (status.of > 0) text = "frame " + std::to_string(status.done) + " of " + std::to_string(status.of);
  if (status.done > 0 && status.seconds > 0)
    text += document::formatted(", %.1f frames/s", status.done / status.seconds);
  if (status.left) text += ", " + launch::clock_text(*status.left) + " left";
  return text.empty() ? "begins" : text;
}

std::string run_line(const FolderState::Run& run) {
  const sinks::ProcessName& process = run.claim.process;
  std::string text = "run on " + process.host + " (process " + std::to_string(process.number) + "): ";
  if (run.ended) return text + "has ended before its last frame";
  text += run.status ? progress_of(*run.status) : "begins";
  if (run.silent > kLate) text += "; has said nothing for " + launch::clock_text(static_cast<double>(run.silent));
  return text;
}

std::string trouble_of(const sinks::Status::Node& node) {
  std::string text;
  if (node.silent >= kNamedSilence) {
    text = document::formatted("; node %d silent for %.0f s", node.node, node.silent);
    if (!node.doing.empty()) text += ", in " + node.doing;
    if (node.frame >= 0) text += " of frame " + std::to_string(node.frame);
  }
  if (node.slow >= kSlow) text += document::formatted("; node %d takes %.1f times as long", node.node, node.slow);
  return text;
}

std::string machine_line(const sinks::Status::Machine& machine) {
  std::uint64_t frames = 0;
  std::string troubles;
  for (const sinks::Status::Node& node : machine.nodes) {
    frames += node.frames;
    troubles += trouble_of(node);
  }
  return "  " + machine.name + "  " + document::counted(machine.nodes.size(), "node") + ", " +
         document::counted(frames, "frame") + troubles;
}

}  // namespace

bool FolderState::Run::lives() const { return !ended && silent < kLost; }

bool FolderState::active() const {
  const bool may_have_jobs = !jobs.empty() || (!no_jobs.empty() && !complete());
  return may_have_jobs || std::ranges::any_of(runs, &Run::lives);
}

FolderState look_at(const fs::path& folder) {
  FolderState state;
  state.folder = folder.string();
  const std::vector<Jobs> jobs = jobs_of(folder);
  if (!jobs.empty()) find_jobs(state, jobs);
  state.runs = runs_in(folder);
  if (jobs.empty() || fs::exists(folder / "frames.json")) count_frames(state, folder);
  return state;
}

std::string text_of(const sinks::Usage& used) {
  if (used == sinks::Usage()) return "";
  const double megabytes = static_cast<double>(used.bytes) / 1e6;
  const double hours = used.processor_hours();
  return (hours < kLeastHours ? document::formatted("%.1f processor seconds, ", used.processor_seconds)
                              : document::formatted("%.2f processor hours, ", hours)) +
         (megabytes < 1000 ? document::formatted("%.1f MB", megabytes)
                           : document::formatted("%.1f GB", megabytes / 1000)) +
         " written, " + document::counted(used.restarts, "restart");
}

std::vector<std::string> lines_of(const FolderState& state, bool machines) {
  std::vector<std::string> lines{folder_line(state)};
  if (const std::string used = text_of(state.used); machines && !used.empty()) lines.push_back("used: " + used);
  for (const QueuedJob& job : state.jobs) lines.push_back(text_of(job));
  if (!state.no_jobs.empty()) lines.push_back("jobs are unknown: " + state.no_jobs);
  for (const FolderState::Run& run : state.runs) {
    lines.push_back(run_line(run));
    if (!machines || !run.status) continue;
    std::ranges::transform(run.status->machines, std::back_inserter(lines), machine_line);
    for (const std::string& warning : run.status->warnings) lines.push_back("  warning: " + warning);
  }
  return lines;
}

}  // namespace mars::batch
