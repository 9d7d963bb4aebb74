#include "host/shell/batch/batch_script.h"

#include <unistd.h>

#include <algorithm>
#include <iterator>
#include <map>

#include "hal/failure/failure.h"
#include "host/child/descriptor.h"
#include "host/child/programs.h"
#include "host/content/document/file.h"
#include "host/content/document/shell_word.h"
#include "host/content/document/text.h"
#include "host/shell/batch/ask.h"

namespace mars::batch {

namespace {

using Words = std::vector<std::string>;
using Values = std::map<std::string, std::string>;

constexpr std::string_view kStart = "film=(";
constexpr std::string_view kShared = "# From here on the scripts of all batch systems are the same.";
constexpr std::uint64_t kBefore = 120;  // seconds from the end of MARS to the time limit

Words quoted_words(const Words& words) {
  Words quoted;
  std::ranges::transform(words, std::back_inserter(quoted), document::shell_word);
  return quoted;
}

std::string quoted(const Words& words) { return document::joined(quoted_words(words), " "); }

// In what sbatch takes, % begins a field.
std::string escaped(const std::string& path) {
  std::string text;
  for (const char letter : path) text += letter == '%' ? "%%" : std::string(1, letter);
  return text;
}

std::string output_of(const BatchSystem& system, const BatchJob& job) {
  if (!system.setup.empty()) return (job.kept / system.output).string();
  return escaped(job.kept.string()) + "/" + (job.parts.size() > 1 ? "%A_%a.out" : system.output);
}

// A name without a value has the text "".
Values values_of(const BatchSystem& system, const BatchJob& job) {
  Values values = {{"nodes", std::to_string(job.machines)},
                   {"tasks", std::to_string(job.tasks)},
                   {"each", std::to_string((job.tasks + job.machines - 1) / job.machines)},
                   {"time", job.time},
                   {"partition", job.partition},
                   {"script", (job.kept / system.script_name).string()},
                   {"output", output_of(system, job)}};
  for (const char* name : {"minutes", "seconds", "timeout", "again"}) values[name] = "";
  if (const auto seconds = seconds_of(job.time)) {
    values["minutes"] = std::to_string((*seconds + 59) / 60);
    values["seconds"] = std::to_string(*seconds);
    const std::uint64_t left = *seconds > kBefore ? *seconds - kBefore : 1;
    values["timeout"] = "timeout --foreground --signal=TERM " + std::to_string(left) + " ";
  }
  return values;
}

struct Filled {
  std::string text{};
  bool complete = true;  // all that it names has a value
};

// In one pass: values may hold braces of their own.
Filled filled(const std::string& text, const Values& values) {
  Filled filled;
  std::size_t from = 0;
  while (from < text.size()) {
    const std::size_t brace = std::min(text.find('{', from), text.size());
    filled.text.append(text, from, brace - from);
    const auto value = std::ranges::find_if(values, [&](const auto& each) {
      return text.compare(brace, each.first.size() + 2, "{" + std::string(each.first) + "}") == 0;
    });
    from = brace;
    if (value != values.end()) {
      filled.text += value->second;
      filled.complete = filled.complete && !value->second.empty();
      from += value->first.size() + 2;
    } else if (from < text.size()) {
      filled.text += text[from++];
    }
  }
  return filled;
}

Words filled_words(const Words& words, const BatchJob& job, const Values& values) {
  Words all;
  for (const std::string& word : words) {
    if (word == "{more}")
      all.insert(all.end(), job.more.begin(), job.more.end());
    else
      all.push_back(filled(word, values).text);
  }
  return all;
}

std::string head_text(const BatchSystem& system, const BatchJob& job, const Values& values) {
  std::string text = "#!/bin/bash\n";
  for (const std::string& option : system.options)
    if (const Filled line = filled(option, values); line.complete) text += line.text + "\n";
  if (job.parts.size() > 1) text += "#SBATCH --array=0-" + std::to_string(job.parts.size() - 1) + "\n";
  if (!job.more.empty()) text += "# mars submit calls " + system.programs.front() + " with: " + quoted(job.more) + "\n";
  if (!job.prologue.empty()) text += job.prologue + (job.prologue.ends_with('\n') ? "" : "\n");
  return text;
}

// The words that the script would be called with.
std::string words_text(const BatchJob& job) {
  Words words = quoted_words(job.words);
  std::string text = "export PATH=" + document::shell_word(job.programs.string()) + ":$PATH\n" +
                     "kept=" + document::shell_word(job.kept.string()) + "\n";
  if (job.parts.size() > 1) {
    Words parts;
    for (const film::FrameSet& part : job.parts) parts.push_back(part.text());
    text += "# The frames of each task of the array.\nframes=(" + document::joined(parts, " ") + ")\n";
    words.insert(words.end(), {"--frames", "\"${frames[SLURM_ARRAY_TASK_ID]}\""});
  } else if (job.parts.size() == 1) {
    words.insert(words.end(), {"--frames", job.parts.front().text()});
  }
  return text + "set -- " + document::joined(words, " ") + "\n";
}

// The place of the first line that begins so, which is there.
std::size_t line_with(const std::string& text, std::string_view beginning) {
  const std::size_t at = text.find("\n" + std::string(beginning));
  check(at != std::string::npos, "the script has all its parts");
  return at + 1;
}

// Slurm's part of its own script: without its options, and until what all systems share.
std::string setup_of(const BatchSystem& system, const std::string& script_template, const Values& values) {
  if (!system.setup.empty()) return filled(system.setup, values).text + "\n";
  std::size_t from = 0;
  while (script_template.compare(from, 2, "#!") == 0 || script_template.compare(from, 8, "#SBATCH ") == 0)
    from = script_template.find('\n', from) + 1;
  return script_template.substr(from, line_with(script_template, kShared) - from);
}

}  // namespace

std::optional<std::uint64_t> seconds_of(const std::string& time) {
  const std::size_t dash = time.find('-');
  std::vector<std::uint64_t> parts;
  for (std::size_t from = dash == std::string::npos ? 0 : dash + 1; from <= time.size();) {
    const std::size_t end = std::min(time.find(':', from), time.size());
    const auto number = document::number_in<std::uint32_t>(time.substr(from, end - from));
    if (!number) return std::nullopt;
    parts.push_back(*number);
    from = end + 1;
  }
  if (parts.empty() || parts.size() > 3) return std::nullopt;
  std::uint64_t days = 0;
  if (dash != std::string::npos) {
    const auto number = document::number_in<std::uint32_t>(time.substr(0, dash));
    if (!number) return std::nullopt;
    days = *number;
  } else if (parts.size() < 3) {
    parts.insert(parts.begin(), 0);  // hours
  }
  parts.resize(3);
  return ((days * 24 + parts[0]) * 60 + parts[1]) * 60 + parts[2];
}

std::string script_template(const std::filesystem::path& self) {
  return document::read_file(self.parent_path().parent_path() / "share" / "mars" / "slurm" / "render.sbatch", 1 << 20);
}

std::string batch_script(const BatchSystem& system, const std::string& script_template, const BatchJob& job) {
  Values values = values_of(system, job);
  values["again"] = quoted(filled_words(system.again, job, values));
  std::string setup = setup_of(system, script_template, values);
  setup.insert(line_with(setup, kStart), words_text(job));
  return head_text(system, job, values) + setup + script_template.substr(line_with(script_template, kShared));
}

// Only complaints about the script begin with its file's name; others are about this machine, such as its locale.
void check_script(const std::string& script) {
  constexpr std::size_t kLongest = 200;  // bytes of what bash says
  const std::string bash = "/bin/bash";  // the script names it; only the machines of the job need it
  if (!child::runnable(bash)) return;
  const child::Descriptor file = child::file_in_memory(script);
  const std::string name = "/proc/" + std::to_string(getpid()) + "/fd/" + std::to_string(file.number());
  const Answer answer = ask("bash", {bash, "-n", name});
  const std::size_t at = answer.complaints.find(name + ": ");
  if (answer.ending.well() && at == std::string::npos) return;
  std::string reason = answer.complaints.substr(at == std::string::npos ? 0 : at + name.size() + 2);
  reason.resize(std::min(reason.size(), reason.find("; " + name)));
  throw Failure("bash cannot read the batch script: " + document::printable(reason, kLongest), "",
                "correct the file of --prologue; mars submit --print shows the script");
}

Words submit_words(const BatchSystem& system, const BatchJob& job) {
  return filled_words(system.submit, job, values_of(system, job));
}

}  // namespace mars::batch
