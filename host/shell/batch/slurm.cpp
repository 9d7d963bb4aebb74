#include "host/shell/batch/slurm.h"

#include <algorithm>
#include <array>
#include <cctype>

#include "hal/failure/failure.h"
#include "host/child/child.h"
#include "host/child/environment.h"
#include "host/child/programs.h"
#include "host/content/document/text.h"

namespace mars::batch {

namespace {

struct Answer {
  child::Ending ending;
  std::vector<std::string> lines;
  std::string complaints;  // on one line
};

std::string path_of(const std::string& program) {
  const auto found = child::find_program(program, child::program_path(child::own_environment()));
  if (!found)
    throw Failure("Slurm's " + program + " was not found", "",
                  "use a machine on which sbatch works; without Slurm: mars render");
  return found->string();
}

Answer ask(const std::string& program, std::vector<std::string> words) {
  words.insert(words.begin(), path_of(program));
  Answer answer;
  child::Child child(child::Command{{}, words});
  answer.ending = child.wait(
      {[&](const std::string& line) { answer.lines.push_back(line); },
       [&](const std::string& line) { answer.complaints += (answer.complaints.empty() ? "" : "; ") + line; }, [] {}});
  child::fail_if_stopped(child);
  return answer;
}

[[noreturn]] void refuse(const std::string& program, const Answer& answer) {
  const std::string words = answer.complaints.empty() ? "without a word" : answer.complaints;
  throw Failure(program + " failed: " + words, "", "");
}

bool is_number(const std::string& text) {
  return !text.empty() && std::ranges::all_of(text, [](unsigned char c) { return std::isdigit(c); });
}

// Squeue's words for a single job that it does not know any more.
bool is_gone(const Answer& answer) { return answer.complaints.find("Invalid job id") != std::string::npos; }

std::string lower(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

}  // namespace

std::string text_of(const QueuedJob& job) {
  std::string text = "job " + job.id + ": " + lower(job.state);
  if (!job.machines.empty()) text += " on " + job.machines + " for " + job.time;
  if (job.machines.empty() && !job.reason.empty() && job.reason != "None") text += " (" + job.reason + ")";
  if (job.restarts > 0) text += ", " + document::counted(job.restarts, "restart");
  return text;
}

QueuedJob queued_job_of(const std::string& line) {
  std::array<std::string, 6> fields;
  std::size_t from = 0;
  for (std::string& field : fields) {
    const std::size_t bar = line.find('|', from);
    if (bar == std::string::npos)
      throw Failure("squeue's answer is not understood: " + document::printable(line), "", "");
    field = line.substr(from, bar - from);
    from = bar + 1;
  }
  const auto& [id, state, time, restarts, machines, reason] = fields;
  return {id, state, time, document::number_in<std::uint32_t>(restarts).value_or(0), machines, reason};
}

void check_slurm() { path_of("sbatch"); }

// What a person says comes last, so it counts.
std::string submit_job(const std::filesystem::path& script, const std::string& output,
                       const std::vector<std::string>& more) {
  std::vector<std::string> words{"--parsable", "--output=" + output};
  words.insert(words.end(), more.begin(), more.end());
  words.push_back(script.string());
  const Answer answer = ask("sbatch", words);
  if (!answer.ending.well() || answer.lines.empty()) refuse("sbatch", answer);
  const std::string& line = answer.lines.back();  // "12", or "12;cluster"
  const std::string number = line.substr(0, line.find(';'));
  if (!is_number(number)) throw Failure("sbatch's answer is not understood: " + document::printable(line), "", "");
  return number;
}

std::vector<QueuedJob> queued_jobs(const std::vector<std::string>& numbers) {
  if (numbers.empty()) return {};
  const Answer answer = ask("squeue", {"--noheader", "--jobs=" + document::joined(numbers, ","),
                                       "--Format=JobArrayID:|,State:|,TimeUsed:|,RestartCnt:|,NodeList:|,Reason:|"});
  if (is_gone(answer)) return {};
  if (!answer.ending.well()) refuse("squeue", answer);
  std::vector<QueuedJob> jobs;
  for (const std::string& line : answer.lines)
    if (!line.empty()) jobs.push_back(queued_job_of(line));
  return jobs;
}

void cancel_jobs(const std::vector<std::string>& numbers) {
  const Answer answer = ask("scancel", numbers);
  if (!answer.ending.well() && !is_gone(answer)) refuse("scancel", answer);
}

}  // namespace mars::batch
