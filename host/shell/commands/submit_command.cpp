#include "host/shell/commands/submit_command.h"

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "hal/failure/failure.h"
#include "host/child/environment.h"
#include "host/child/programs.h"
#include "host/cli/command.h"
#include "host/content/document/file.h"
#include "host/content/document/shell_line.h"
#include "host/content/document/text.h"
#include "host/content/document/work_folder.h"
#include "host/render/farm/plan.h"
#include "host/render/farm/rough_work.h"
#include "host/render/resume/resume.h"
#include "host/shell/batch/array_parts.h"
#include "host/shell/batch/batch_script.h"
#include "host/shell/batch/batch_system.h"
#include "host/shell/batch/queued_jobs.h"
#include "host/shell/batch/remembered_jobs.h"
#include "host/shell/job/film_of.h"
#include "host/shell/launch/film_audio.h"
#include "host/shell/options/render_options.h"
#include "host/videos/write_video.h"

namespace mars::commands {
namespace {

namespace fs = std::filesystem;

constexpr std::uint32_t kMostMachines = 1 << 16;
constexpr std::uint32_t kMostTasks = 1 << 20;
constexpr std::uint32_t kMostParts = 1000;            // Slurm's MaxArraySize is 1001 by default
constexpr double kWorthSaying = 0.005;                // of more work
constexpr std::uintmax_t kLongestPrologue = 1 << 20;  // bytes

struct SubmitWords {
  options::RenderOptions render;
  batch::BatchJob job;
  std::uint32_t parts = 1;          // of an array
  std::vector<std::string> sbatch;  // each a text of one or several words
  bool print = false, parsable = false;
};

// In a line of the script a blank would end it.
std::string one_word(const std::string& text) {
  const bool plain = !text.empty() && text.find_first_of(" \t\n\r#'\"\\") == std::string::npos;
  return plain ? "" : "'" + text + "' is not one word";
}

// In the script they are a comment, which a line's end would end.
std::string words_on_a_line(const std::string& text) {
  if (text.find_first_of("\n\r") != std::string::npos) return "more than one line";
  try {
    document::shell_words(text);
  } catch (const Failure& failure) {
    return failure.what();
  }
  return "";
}

// Bash would take a carriage return for a part of the line's last word, and leave out bytes of 0.
std::string prologue_in(const std::string& file) {
  const std::string text = document::read_file(file, kLongestPrologue);
  const std::size_t odd = std::min(text.find("\r\n"), text.find('\0'));
  if (odd == std::string::npos) return text;
  const auto line = std::to_string(1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(odd), '\n'));
  throw Failure(text[odd] == '\r' ? "line " + line + " ends with CR LF" : "line " + line + " is no text", file,
                "save it as a text with line ends of Unix");
}

void add_job_options(cli::Command command, SubmitWords& words) {
  command
      .add("--nodes", words.job.machines,
           "Machines, which Slurm calls nodes; default: 4. On each of them several nodes of MARS may run. "
           "Example: --nodes 8")
      .type("N")
      .range(std::uint32_t{1}, kMostMachines);
  command
      .add("--tasks", words.job.tasks,
           "Processes on all machines: one is the host, each other a node that renders; default: 32. "
           "Example: --tasks 128")
      .type("N")
      .range(std::uint32_t{2}, kMostTasks);
  command
      .add("--time", words.job.time,
           "Time limit, in the form of sbatch. Before the limit the job queues itself again, until all frames are "
           "there. Example: --time 8:00:00")
      .type("TIME")
      .check(one_word);
  command.add("--partition", words.job.partition, "Partition of Slurm, or queue. Example: --partition long")
      .type("NAME")
      .check(one_word);
  command
      .add("--array", words.parts,
           "Number of jobs side by side; each has the machines and tasks above, and an equal share of the film's work. "
           "Example: --array 10")
      .type("N")
      .range(std::uint32_t{1}, kMostParts);
  command
      .add("--sbatch", words.sbatch,
           "More options for sbatch, or for qsub, bsub or flux batch, quoted as one word of the shell; they override "
           "the options above and those of the script and the environment. You can give this option several times. "
           "Example: --sbatch \"--account=physics --qos=long\"")
      .repeated()
      .type("WORDS")
      .check(words_on_a_line);
  command
      .add_read(
          "--prologue", [&](const std::string& word) { words.job.prologue = prologue_in(word); },
          "Lines of the shell for the script, before anything of MARS starts. Example: --prologue modules.sh")
      .type("FILE");
  command.add_flag("--parsable", words.parsable, "Print the number of the job and nothing else. Example: --parsable");
  command.add_flag("--print", words.print, "Print the batch script; submit nothing. Example: --print");
}

void warn_submitter(const std::string& line) { std::cerr << "mars: warning: " << line << '\n'; }

// What is wrong with the film shows now, not when the job begins. Where the job is submitted, the film lies in the
// folder from then on, for every start of the job to take, whatever becomes of the film's files.
film::CompiledFilm film_of(const SubmitWords& words) {
  const options::RenderOptions& render = words.render;
  if (!render.videos.empty()) launch::audio_of_film(render.film);  // throws where the sound is missing
  const auto compile = [&] { return job::load_film_of(render, warn_submitter); };
  const resume::Wish wish{.folder = render.folder,
                          .film = render.film,
                          .options = options::film_arguments(render),
                          .form = options::form_of(render),
                          .frames = render.frames,
                          .overwrite = render.overwrite,
                          .kept_film = render.kept_film,
                          .renders = false};
  if (words.print) return resume::film_for(wish, compile);
  std::optional<document::WorkFolder> work;  // stays, with the film in it, for the job
  if (render.own_folder)
    work.emplace(render.videos.front(), document::WorkFolder::Use::alone,
                 [&] { warn_submitter(videos::waiting_text({render.videos.front()})); });
  resume::Opened opened = resume::open(wish, compile, {.warn = warn_submitter});
  if (!opened.changed.empty()) (words.parsable ? std::cerr : std::cout) << opened.changed << '\n';
  return std::move(opened.film);
}

// More than one frame set: without the option --frames.
batch::ArrayParts parts_of(const SubmitWords& words, const film::CompiledFilm& film) {
  if (words.parts == 1) return {};
  const wire::PackedFilm view = film.view();
  const std::vector<std::uint32_t> frames = words.render.frames.of_film(view.settings().frames);
  const std::vector<farm::Task> tasks = farm::make_tasks(view, frames, !words.render.no_coherence);
  std::vector<farm::RoughWork> works;
  for (const farm::Task& task : tasks) works.push_back(farm::rough_work(view, view.intervals()[task.interval]));
  batch::ArrayParts parts = batch::array_parts(tasks, works, words.parts);
  if (parts.frames.size() < words.parts)
    warn_submitter(document::counted(parts.frames.size(), "job") + " instead of " + std::to_string(words.parts) +
                   ": with so few frames more would not be faster");
  return parts;
}

// More words for the program that submits.
std::vector<std::string> sbatch_words(const SubmitWords& words) {
  std::vector<std::string> all;
  for (const std::string& text : words.sbatch)
    for (std::string& word : document::shell_words(text)) all.push_back(std::move(word));
  return all;
}

batch::BatchJob job_of(const SubmitWords& words, const batch::BatchSystem& system, std::vector<film::FrameSet> parts,
                       const fs::path& self) {
  batch::BatchJob job = words.job;
  job.more = sbatch_words(words);
  job.parts = std::move(parts);
  job.programs = self.parent_path();
  job.kept = fs::absolute(words.render.folder) / system.folder;
  options::RenderOptions render = words.render;
  render.kept_film = true;
  render.overwrite = false;  // what was there before is gone by then
  if (!job.parts.empty()) render.frames = film::FrameSet();
  job.words = options::arguments_for(options::Program::submit, render);
  return job;
}

// "3 tasks, with 12 % more work than one job's"
std::string array_text(const batch::ArrayParts& parts) {
  const std::string tasks = document::counted(parts.frames.size(), "task");
  if (parts.more_work < kWorthSaying) return tasks;
  return tasks + document::formatted(", with %.0f %% more work than one job's", 100 * parts.more_work);
}

// A script can be printed on a machine without a batch system: Slurm's.
batch::BatchSystem system_for(const SubmitWords& words) try {
  return batch::batch_system_in(child::program_path(child::own_environment()));
} catch (const Failure&) {
  if (!words.print) throw;
  return batch::batch_systems().front();
}

void check_system(const SubmitWords& words, const batch::BatchSystem& system) {
  const bool is_slurm = system.name == batch::batch_systems().front().name;
  if (!is_slurm && words.parts > 1)
    throw cli::UsageError("--array", "only Slurm gets an array of jobs from mars; leave it out for " + system.name);
  if (!is_slurm && !words.job.time.empty() && batch::seconds_of(words.job.time).value_or(0) == 0)
    throw cli::UsageError("--time",
                          "'" + words.job.time + "' is not a time such as 8:00:00, which " + system.name + " needs");
}

void print_number(const SubmitWords& words, const std::string& number, const batch::ArrayParts& parts) {
  const bool array = parts.frames.size() > 1;
  if (words.parsable)
    std::cout << number << '\n';
  else
    std::cout << "job " << number << (array ? ", " + array_text(parts) : "") << "; follow it with: mars watch "
              << options::word_of_file(words.render.folder) << '\n';
}

void submit(const SubmitWords& words) {
  const fs::path self = child::own_file();
  const batch::BatchSystem system = system_for(words);
  check_system(words, system);
  const batch::ArrayParts parts = parts_of(words, film_of(words));
  const batch::BatchJob job = job_of(words, system, parts.frames, self);
  const std::string script = batch::batch_script(system, batch::script_template(self), job);
  if (words.print) {
    std::cout << script;
    return;
  }
  batch::check_script(script);
  for (const std::string& doubt : batch::doubts_of(system, job)) warn_submitter(doubt);
  const batch::RememberedJobs jobs(words.render.folder, system);
  jobs.write_script(script);
  const std::string number = batch::submit_job(system, job);
  jobs.add(number);
  print_number(words, number, parts);
}

void check_words(const SubmitWords& words) {
  if (words.parts > 1 && (!words.render.report.empty() || !words.render.trace.empty()))
    throw cli::UsageError("--array", "its jobs cannot share one file: leave out --report and --trace");
  if (words.parts > 1 && !words.render.videos.empty())
    throw cli::UsageError("--array",
                          "each of its jobs has some of the frames only: give -o DIR alone, and then mars play "
                          "DIR -o " +
                              words.render.videos.front());
  const auto makes_array = [](const std::string& word) { return word.starts_with("--ar") || word.starts_with("-a"); };
  if (words.parts == 1 && std::ranges::any_of(sbatch_words(words), makes_array))
    throw cli::UsageError("--sbatch",
                          "each job of an array would render all frames: add --array N of mars submit, "
                          "which cuts the film among them");
}

}  // namespace

void add_submit(cli::Command app) {
  const auto words = std::make_shared<SubmitWords>();
  const cli::Command command = app.add_command("submit", "Render a film by a job of Slurm, PBS, LSF or Flux");
  options::add_render_options(command, words->render, options::Program::submit);
  add_job_options(command, *words);
  command.footer(
      "mars submit writes the compiled film into DIR. Each start of the job renders\nthis film, even if FILM has "
      "changed or is gone. The variables that sbatch reads\nwork, too: SBATCH_ACCOUNT, SBATCH_QOS, SBATCH_EXCLUSIVE "
      "and others.\n");
  command.runs([words] {
    check_words(*words);
    submit(*words);
  });
}

}  // namespace mars::commands
