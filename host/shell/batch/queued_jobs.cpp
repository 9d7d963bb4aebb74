#include "host/shell/batch/queued_jobs.h"

#include <algorithm>
#include <cctype>
#include <sstream>

#include "hal/failure/failure.h"
#include "host/child/environment.h"
#include "host/child/programs.h"
#include "host/content/document/text.h"

namespace mars::batch {

namespace {

using Words = std::vector<std::string>;

constexpr std::uint64_t kShort = 600;  // seconds of a time limit, which Slurm announces two to three minutes before

std::string own_path() { return child::program_path(child::own_environment()); }

[[noreturn]] void refuse(const std::string& program, const Answer& answer) {
  const std::string words = answer.complaints.empty() ? "without a word" : answer.complaints;
  throw Failure(program + " failed: " + words, "", "");
}

[[noreturn]] void fail_to_understand(const std::string& program, const std::string& line) {
  throw Failure(program + "'s answer is not understood: " + document::printable(line), "", "");
}

bool names_unknown_job(const BatchSystem& system, const Answer& answer) {
  return std::ranges::any_of(
      system.unknown, [&](const std::string& part) { return answer.complaints.find(part) != std::string::npos; });
}

std::string lower(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

Words fields_of(const std::string& line, char separator) {
  Words fields;
  std::istringstream text(line);
  std::string field;
  while (separator == ' ' ? static_cast<bool>(text >> field) : static_cast<bool>(std::getline(text, field, separator)))
    fields.push_back(field);
  return fields;
}

bool is_state(const std::string& text) {
  return !text.empty() && std::ranges::all_of(text, [](unsigned char c) { return std::isalpha(c) || c == '_'; });
}

std::string state_text(const BatchSystem& system, const std::string& state) {
  const auto known = std::ranges::find_if(system.states, [&](const auto& word) { return word[0] == state; });
  return known == system.states.end() ? lower(state) : (*known)[1];
}

// The number of its lines. An answer without a header says nothing about jobs, not even that there are none.
std::size_t header_of(const BatchSystem& system, const Words& lines) {
  const auto header = static_cast<std::size_t>(system.header);
  if (header == 0 || lines.empty()) return 0;
  if (lines.size() < header || !lines[header - 1].starts_with("--"))
    fail_to_understand(system.list.front(), lines.front());
  return header;
}

// With the jobs' numbers for {jobs}, as words of their own or within a word.
Words words_for(const Words& words, const Words& numbers) {
  const std::string key = "{jobs}";
  Words all;
  for (std::string word : words) {
    const std::size_t at = word.find(key);
    if (word == key)
      all.insert(all.end(), numbers.begin(), numbers.end());
    else
      all.push_back(at == std::string::npos ? word : word.replace(at, key.size(), document::joined(numbers, ",")));
  }
  return all;
}

// "12", "12;cluster", "12.server", "Job <12> is submitted to queue <long>."
std::string number_in(const std::string& answer) {
  const std::size_t open = answer.find('<');
  if (open != std::string::npos) return answer.substr(open + 1, answer.find('>') - open - 1);
  return answer.substr(0, answer.find(';'));
}

std::string short_limit_doubt(const BatchJob& job) {
  const auto seconds = seconds_of(job.time);
  if (!seconds || *seconds == 0 || *seconds >= kShort) return "";
  return "the time limit " + job.time + " is " + document::counted(*seconds, "second") +
         ", and the job is asked to end 2 to 3 minutes before it: it may never come to a frame; give 10 minutes or "
         "more";
}

// "main*|4|0/8/0/8", of which the star marks the default and the last number is all processors; "": it has enough.
std::string partition_doubt(const std::string& line, const BatchJob& job, const std::string& partition) {
  const Words fields = fields_of(line, '|');
  if (fields.size() != 3) return "";
  const bool is_default = fields[0].ends_with('*');
  const std::string name = fields[0].substr(0, fields[0].size() - is_default);
  if (partition.empty() ? !is_default : name != partition) return "";
  const auto machines = document::number_in<std::uint32_t>(fields[1]);
  const auto processors = document::number_in<std::uint32_t>(fields[2].substr(fields[2].rfind('/') + 1));
  if (!machines || !processors || (job.machines <= *machines && job.tasks <= *processors)) return "";
  return "the partition " + name + " has " + document::counted(*machines, "machine") + " with " +
         document::counted(*processors, "processor") + ", and the job asks for " +
         document::counted(job.machines, "machine") + " and " + document::counted(job.tasks, "task") +
         ": it may wait for ever; give smaller --nodes or --tasks";
}

Words partition_lines(std::chrono::milliseconds longest) try {
  return ask("sinfo", {"sinfo", "--noheader", "--format=%P|%D|%C"}, longest).lines;
} catch (const NoAnswer&) {
  return {};
}

// Whether a person's own words, which count more than MARS's, may choose a partition, machines or tasks.
bool chooses_itself(const BatchJob& job) {
  return std::ranges::any_of(job.more, [](const std::string& word) {
    const auto begins = [&](std::string_view option) { return word.starts_with(option); };
    return begins("-p") || begins("-n") || begins("-N") || begins("--partition") || begins("--n");
  });
}

}  // namespace

std::string text_of(const QueuedJob& job) {
  std::string text = "job " + job.id + ": " + job.state;
  if (!job.machines.empty()) text += " on " + job.machines;
  if ((!job.machines.empty() || job.state == "running") && !job.time.empty()) text += " for " + job.time;
  if (job.machines.empty() && !job.reason.empty()) text += " (" + job.reason + ")";
  if (job.restarts > 0) text += ", " + document::counted(job.restarts, "restart");
  return text;
}

std::optional<QueuedJob> queued_job_of(const BatchSystem& system, const std::string& line) {
  const BatchSystem::Columns& columns = system.columns;
  const Words fields = fields_of(line, columns.separator);
  const auto field = [&](int column) {
    if (column < 0) return std::string();
    if (static_cast<std::size_t>(column) >= fields.size()) fail_to_understand(system.list.front(), line);
    const std::string& text = fields[static_cast<std::size_t>(column)];
    return text == "None" || text == "-" ? "" : text;
  };
  const std::string state = field(columns.state);
  if (!is_state(state)) fail_to_understand(system.list.front(), line);
  QueuedJob job{field(columns.id),       state_text(system, state),
                field(columns.time),     document::number_in<std::uint32_t>(field(columns.restarts)).value_or(0),
                field(columns.machines), field(columns.reason)};
  if (std::ranges::find(system.ended, state) != system.ended.end()) return std::nullopt;
  return job;
}

bool is_job_number(const std::string& text) {
  constexpr std::size_t kLongest = 64;  // bytes
  const auto is_odd = [](unsigned char c) { return c <= ' ' || c == 0x7f || c == ';' || c == ','; };
  return !text.empty() && text.size() <= kLongest && text.front() != '-' && std::ranges::none_of(text, is_odd);
}

std::string submit_job(const BatchSystem& system, const BatchJob& job, std::chrono::milliseconds longest) {
  const std::string& program = system.programs.front();
  const Answer answer = ask(program, submit_words(system, job), longest);
  if (!answer.ending.well() || answer.lines.empty()) refuse(program, answer);
  const std::string number = number_in(answer.lines.back());
  if (!is_job_number(number)) fail_to_understand(program, answer.lines.back());
  return number;
}

std::vector<QueuedJob> queued_jobs(const std::vector<Jobs>& all, std::chrono::milliseconds longest) {
  std::vector<QueuedJob> queued;
  for (const auto& [of, numbers] : all) {
    const BatchSystem& system = *of;
    const Answer answer = ask(system.list.front(), words_for(system.list, numbers), longest);
    if (!answer.ending.well() && !names_unknown_job(system, answer)) refuse(system.list.front(), answer);
    const std::size_t header = header_of(system, answer.lines);
    for (std::size_t i = header; i < answer.lines.size(); ++i) {
      if (answer.lines[i].empty()) continue;
      if (auto job = queued_job_of(system, answer.lines[i])) queued.push_back(std::move(*job));
    }
  }
  return queued;
}

void cancel_jobs(const std::vector<Jobs>& all, std::chrono::milliseconds longest) {
  for (const auto& [of, numbers] : all) {
    const BatchSystem& system = *of;
    Words words = system.cancel;
    words.insert(words.end(), numbers.begin(), numbers.end());
    const Answer answer = ask(words.front(), words, longest);
    if (!answer.ending.well() && !names_unknown_job(system, answer)) refuse(system.cancel.front(), answer);
  }
}

std::vector<std::string> doubts_of(const BatchSystem& system, const BatchJob& job, std::chrono::milliseconds longest) {
  Words doubts{short_limit_doubt(job)};
  if (system.name == "Slurm" && !chooses_itself(job) && child::find_program("sinfo", own_path())) {
    const auto given = child::own_environment().value("SBATCH_PARTITION");
    for (const std::string& line : partition_lines(longest))
      doubts.push_back(partition_doubt(line, job, job.partition.empty() ? given.value_or("") : job.partition));
  }
  std::erase(doubts, "");
  return doubts;
}

}  // namespace mars::batch
