#include "host/shell/batch/state_text.h"

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "host/content/document/text.h"

namespace mars::batch {
namespace {

using nlohmann::ordered_json;

std::string word_of(const FolderState& state) {
  if (state.complete()) return "complete";
  if (std::ranges::any_of(state.runs, &FolderState::Run::lives)) return "rendering";
  if (!state.jobs.empty()) return "waiting";
  return state.no_jobs.empty() ? "incomplete" : "unknown";
}

ordered_json json_of(const QueuedJob& job) {
  return {{"job", job.id},
          {"state", job.state},
          {"time", job.time},
          {"restarts", job.restarts},
          {"machines", job.machines},
          {"reason", job.reason}};
}

ordered_json json_of(const FolderState::Run& run) {
  ordered_json text = {{"host", run.claim.process.host},
                       {"process", run.claim.process.number},
                       {"lives", run.lives()},
                       {"silent_seconds", run.silent}};
  if (!run.status) return text;
  text["done"] = run.status->done;
  text["of"] = run.status->of;
  if (run.status->left) text["seconds_left"] = *run.status->left;
  text["machines"] = run.status->machines.size();
  text["warnings"] = run.status->warnings;
  return text;
}

template <typename Items>
ordered_json list_of(const Items& items) {
  ordered_json list = ordered_json::array();
  for (const auto& item : items) list.push_back(json_of(item));
  return list;
}

// Folders' names need not be UTF-8, metrics must be.
std::string label_of(const std::string& folder) {
  std::string text;
  for (const char letter : document::in_utf8(std::filesystem::absolute(folder).lexically_normal().string())) {
    if (letter == '\\' || letter == '"') text += '\\';
    text += letter == '\n' ? "\\n" : std::string(1, letter);
  }
  return text;
}

}  // namespace

std::string json_of(const FolderState& state) {
  const ordered_json text = {
      {"folder", state.folder},
      {"film", state.film},
      {"state", word_of(state)},
      {"frames", {{"done", state.there}, {"of", state.of}}},
      {"usage",
       {{"processor_hours", document::rounded_to(state.used.processor_hours(), 6)},
        {"bytes", state.used.bytes},
        {"restarts", state.used.restarts}}},
      {"jobs", list_of(state.jobs)},
      {"jobs_unknown", state.no_jobs},
      {"runs", list_of(state.runs)},
  };
  return text.dump(-1, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

// All are gauges: counters have names that the two formats do not agree about.
std::string metrics_of(const FolderState& state) {
  const std::string label = label_of(state.folder);
  std::string text;
  const auto add = [&](const std::string& name, const std::string& help, double value) {
    text += "# HELP mars_" + name + " " + help + "\n# TYPE mars_" + name + " gauge\nmars_" + name + "{folder=\"" +
            label + "\"} " + document::formatted("%.15g", value) + "\n";
  };
  const auto lives = std::ranges::count_if(state.runs, &FolderState::Run::lives);
  add("frames_done", "Frames that are in the folder.", state.there);
  add("frames_wanted", "Frames that runs were asked for.", state.of);
  add("runs", "Runs that render into the folder.", static_cast<double>(lives));
  if (state.no_jobs.empty()) add("jobs", "Batch jobs that have not ended.", static_cast<double>(state.jobs.size()));
  add("processor_seconds", "Time that hosts and nodes of all runs took, each on a processor.",
      state.used.processor_seconds);
  add("written_bytes", "Bytes of frames that were written.", static_cast<double>(state.used.bytes));
  add("restarts", "Runs that ended before their last frame.", state.used.restarts);
  return text + "# EOF\n";
}

std::string comment_of(const FolderState& state) {
  const std::string used = text_of(state.used);
  return "mars: " + std::to_string(state.there) + " of " + document::counted(state.of, "frame") +
         (used.empty() ? "" : ", " + used) + "\n";
}

}  // namespace mars::batch
