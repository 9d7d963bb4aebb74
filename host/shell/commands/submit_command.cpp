#include "host/shell/commands/submit_command.h"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "hal/failure/failure.h"
#include "host/child/programs.h"
#include "host/content/document/checksum.h"
#include "host/content/document/text.h"
#include "host/render/farm/plan.h"
#include "host/render/sinks/frame_folder.h"
#include "host/shell/batch/array_parts.h"
#include "host/shell/batch/batch_script.h"
#include "host/shell/batch/remembered_jobs.h"
#include "host/shell/batch/slurm.h"
#include "host/shell/job/film_of.h"
#include "host/shell/options/render_options.h"

namespace mars::commands {
namespace {

namespace fs = std::filesystem;

constexpr std::uint32_t kMostMachines = 1 << 16;
constexpr std::uint32_t kMostTasks = 1 << 20;
constexpr std::uint32_t kMostParts = 1000;  // Slurm's MaxArraySize is 1001 by default

struct Words {
  options::RenderOptions render;
  std::uint32_t machines = 0;  // 0, "": as the script says
  std::uint32_t tasks = 0;
  std::string time, partition;
  std::uint32_t parts = 1;  // of an array
  bool print = false;
};

// In a line of the script a blank would end it.
std::string one_word(const std::string& text) {
  const bool plain = !text.empty() && text.find_first_of(" \t\n\r#'\"\\") == std::string::npos;
  return plain ? "" : "'" + text + "' is not one word";
}

void add_job_options(CLI::App& command, Words& words) {
  command
      .add_option("--nodes", words.machines,
                  "Machines, which Slurm calls nodes; default: 4. On each of them several nodes of MARS may run. "
                  "Example: --nodes 8")
      ->type_name("N")
      ->check(CLI::Range(std::uint32_t{1}, kMostMachines).description(""));
  command
      .add_option("--tasks", words.tasks,
                  "Processes on all machines: one is the host, each other a node that renders; default: 32. "
                  "Example: --tasks 128")
      ->type_name("N")
      ->check(CLI::Range(std::uint32_t{2}, kMostTasks).description(""));
  command
      .add_option("--time", words.time,
                  "Time limit, as sbatch takes it. The job is queued again before it, until all frames are there. "
                  "Example: --time 8:00:00")
      ->type_name("TIME")
      ->check(one_word);
  command.add_option("--partition", words.partition, "Slurm's partition. Example: --partition long")
      ->type_name("NAME")
      ->check(one_word);
  command
      .add_option("--array", words.parts,
                  "Jobs side by side, each with the machines and tasks above; the film is cut among them where "
                  "intervals begin. Example: --array 10")
      ->type_name("N")
      ->check(CLI::Range(std::uint32_t{1}, kMostParts).description(""));
  command.add_flag("--print", words.print, "Print the batch script; submit nothing. Example: --print");
}

// What would be refused when the job begins, perhaps tomorrow.
void refuse_other_film(const options::RenderOptions& render, const film::CompiledFilm& film) {
  if (!fs::exists(fs::path(render.folder) / "frames.json")) return;
  const sinks::Manifest there = sinks::read_manifest(render.folder);
  if (there.film != render.film && there.checksum != document::checksum_of(film.block()))
    throw Failure("has frames of another film, " + there.film, render.folder, "give another folder with -o");
}

// More than one: without the option --frames.
std::vector<film::FrameSet> parts_of(const Words& words, const film::CompiledFilm& film) {
  if (words.parts == 1) return {};
  const wire::FilmView view = film.view();
  const std::vector<std::uint32_t> frames = words.render.frames.of_film(view.settings().frames);
  std::vector<film::FrameSet> parts =
      batch::array_parts(farm::make_tasks(view, frames, !words.render.no_coherence), words.parts);
  if (parts.size() < words.parts)
    std::cerr << "mars: warning: the film has too few intervals for " << words.parts
              << " jobs: " << document::counted(parts.size(), "job") << '\n';
  return parts;
}

batch::BatchJob job_of(const Words& words, std::vector<film::FrameSet> parts, const fs::path& self) {
  batch::BatchJob job{{}, {}, std::move(parts), self.parent_path()};
  if (words.machines != 0) job.options.emplace_back("nodes", std::to_string(words.machines));
  if (words.tasks != 0) job.options.emplace_back("ntasks", std::to_string(words.tasks));
  if (!words.time.empty()) job.options.emplace_back("time", words.time);
  if (!words.partition.empty()) job.options.emplace_back("partition", words.partition);
  options::RenderOptions render = words.render;
  if (!job.parts.empty()) render.frames = film::FrameSet();
  job.words = options::arguments_for(options::Program::submit, render);
  return job;
}

void submit(const Words& words) {
  const fs::path self = child::own_file();
  const options::RenderOptions& render = words.render;
  if (!words.print) batch::check_slurm();
  // Also what is wrong with the film shows now, not when the job begins.
  const film::CompiledFilm film =
      job::load_film_of(render, [](const std::string& line) { std::cerr << "mars: warning: " << line << '\n'; });
  refuse_other_film(render, film);
  const batch::BatchJob job = job_of(words, parts_of(words, film), self);
  const std::string script = batch::batch_script(batch::script_template(self), job);
  if (words.print) {
    std::cout << script;
    return;
  }
  const batch::RememberedJobs jobs(render.folder);
  const bool array = job.parts.size() > 1;
  const std::string number = batch::submit_job(jobs.write_script(script), jobs.output_pattern(array));
  jobs.add(number);
  std::cout << "job " << number << (array ? ", " + document::counted(job.parts.size(), "task") : "")
            << "; follow it with: mars watch " << options::word_of_file(render.folder) << '\n';
}

void check_words(const Words& words) {
  if (words.parts > 1 && (!words.render.report.empty() || !words.render.trace.empty()))
    throw CLI::ValidationError("--array", "its jobs cannot share one file: leave out --report and --trace");
}

}  // namespace

void add_submit(CLI::App& app) {
  const auto words = std::make_shared<Words>();
  CLI::App* command = app.add_subcommand("submit", "Render a film by a job of Slurm");
  options::add_render_options(*command, words->render, options::Program::submit);
  add_job_options(*command, *words);
  command->footer(
      "What sbatch reads from the environment counts too: SBATCH_ACCOUNT, SBATCH_QOS,\n"
      "SBATCH_EXCLUSIVE and others.\n");
  command->callback([words] {
    check_words(*words);
    submit(*words);
  });
}

}  // namespace mars::commands
