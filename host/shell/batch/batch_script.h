// The script of a job that renders: what is the batch system's own, a film and what the job needs filled in, and what
// all systems share, which is the end of cluster/slurm/render.sbatch.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "host/content/film/frame_set.h"
#include "host/shell/batch/batch_system.h"

namespace mars::batch {

struct BatchJob {
  std::uint32_t machines = 4;
  std::uint32_t tasks = 32;           // processes on all machines
  std::string time;                   // limit, in the form of sbatch; "": none
  std::string partition;              // "": the system's default
  std::vector<std::string> more;      // for the program that submits, in the form a person gave them
  std::vector<std::string> words;     // of mars render, without frames
  std::vector<film::FrameSet> parts;  // for each task of an array; one: no array; none: the words say which frames
  std::filesystem::path programs;     // the folder where mars is
  std::filesystem::path kept;         // where the script is and the job prints
  std::string prologue;               // lines before all that is MARS's
};

// "90", "1:30", "8:00:00", "2-0", "2-12", "2-12:30" or "2-12:30:00", of which the first two are minutes, as sbatch
// reads them; none for what is no time, or has no end.
std::optional<std::uint64_t> seconds_of(const std::string& time);

// The script as it is installed with the program `self`. Throws Failure where it cannot be read.
std::string script_template(const std::filesystem::path& self);

// `script_template`: that of Slurm.
std::string batch_script(const BatchSystem& system, const std::string& script_template, const BatchJob& job);

// Throws Failure, with what bash says, where it cannot read the whole script.
void check_script(const std::string& script);

// The program that submits the script, with its words.
std::vector<std::string> submit_words(const BatchSystem& system, const BatchJob& job);

}  // namespace mars::batch
