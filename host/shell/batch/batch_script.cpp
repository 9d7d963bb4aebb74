#include "host/shell/batch/batch_script.h"

#include <algorithm>
#include <sstream>

#include "host/content/document/file.h"
#include "host/content/document/shell_word.h"
#include "host/content/document/text.h"

namespace mars::batch {

namespace {

constexpr std::string_view kOption = "#SBATCH --";
constexpr std::string_view kStart = "film=(mars render";

// The option that a line of the script sets; "" where it sets none.
std::string option_in(const std::string& line) {
  if (!line.starts_with(kOption)) return "";
  const std::string rest = line.substr(kOption.size());
  return rest.substr(0, rest.find('='));
}

bool replaces(const BatchJob& job, const std::string& line) {
  return std::ranges::any_of(job.options, [&](const auto& option) { return option.first == option_in(line); });
}

std::vector<std::string> quoted_words(const std::vector<std::string>& words) {
  std::vector<std::string> quoted;
  std::ranges::transform(words, std::back_inserter(quoted), document::shell_word);
  return quoted;
}

std::string options_text(const BatchJob& job) {
  std::string text;
  for (const auto& [name, value] : job.options) text += std::string(kOption) + name + "=" + value + "\n";
  if (job.parts.size() > 1) text += std::string(kOption) + "array=0-" + std::to_string(job.parts.size() - 1) + "\n";
  if (!job.sbatch.empty())
    text += "# mars submit calls sbatch with: " + document::joined(quoted_words(job.sbatch), " ") + "\n";
  return text;
}

// What the script would be called with.
std::string words_text(const BatchJob& job) {
  std::vector<std::string> words = quoted_words(job.words);
  std::string text = "PATH=" + document::shell_word(job.programs.string()) + ":$PATH\n";
  if (job.parts.size() > 1) {
    std::vector<std::string> parts;
    for (const film::FrameSet& part : job.parts) parts.push_back(part.text());
    text += "# Of each task of the array.\nframes=(" + document::joined(parts, " ") + ")\n";
    words.insert(words.end(), {"--frames", "\"${frames[SLURM_ARRAY_TASK_ID]}\""});
  } else if (job.parts.size() == 1) {
    words.insert(words.end(), {"--frames", job.parts.front().text()});
  }
  return text + "set -- " + document::joined(words, " ") + "\n";
}

}  // namespace

std::string script_template(const std::filesystem::path& self) {
  return document::read_file(self.parent_path().parent_path() / "share" / "mars" / "slurm" / "render.sbatch", 1 << 20);
}

std::string batch_script(const std::string& script_template, const BatchJob& job) {
  std::istringstream lines(script_template);
  std::string text;
  bool options_written = false;
  for (std::string line; std::getline(lines, line);) {
    const bool option = !option_in(line).empty();
    if (!option && !line.starts_with("#!") && !std::exchange(options_written, true)) text += options_text(job);
    if (line.starts_with(kStart)) text += words_text(job);
    if (!option || !replaces(job, line)) text += line + "\n";
  }
  return text;
}

}  // namespace mars::batch
