// The script of a Slurm job that renders: cluster/slurm/render.sbatch, with a film and what the job needs filled in.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "host/content/film/frame_set.h"

namespace mars::batch {

struct BatchJob {
  // sbatch's options by their long names, which replace the script's own: {"nodes", "4"}.
  std::vector<std::pair<std::string, std::string>> options;
  std::vector<std::string> sbatch;    // more words for sbatch, in the form a person gave them; the script names them
  std::vector<std::string> words;     // of mars render, without frames
  std::vector<film::FrameSet> parts;  // for each task of an array; one: no array; none: the words say which frames
  std::filesystem::path programs;     // the folder where mars is
};

// The script as it is installed with the program `self`. Throws Failure where it cannot be read.
std::string script_template(const std::filesystem::path& self);

std::string batch_script(const std::string& script_template, const BatchJob& job);

}  // namespace mars::batch
