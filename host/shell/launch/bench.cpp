#include "host/shell/launch/bench.h"

#include <algorithm>

#include "hal/failure/failure.h"
#include "host/child/exec.h"
#include "host/content/document/text.h"

namespace mars::launch {
namespace {

namespace fs = std::filesystem;

fs::path folder_of(const fs::path& program) { return program.parent_path().parent_path() / "bench"; }

std::vector<std::string> names_in(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code none;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, none))
    if (fs::exists(entry.path() / "run")) names.push_back(entry.path().filename());
  if (names.empty())
    throw Failure("no benchmarks were built beside this program", folder.string(),
                  "in the sources: ./bootstrap bench, then build/release/bin/mars bench");
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace

std::string list_benchmarks(const fs::path& program) {
  std::string text = "Benchmarks (options: mars bench NAME --help):\n";
  for (const std::string& name : names_in(folder_of(program))) text += "  " + name + "\n";
  return text;
}

void run_benchmark(const fs::path& program, const std::string& name, const std::vector<std::string>& words) {
  const std::vector<std::string> names = names_in(folder_of(program));
  if (std::find(names.begin(), names.end(), name) == names.end()) {
    throw Failure("there is no benchmark '" + name + "'", "", "those here: " + document::joined(names));
  }
  child::Command command{{}, {folder_of(program) / name / "run"}};
  command.words.insert(command.words.end(), words.begin(), words.end());
  child::become(command, "build it again: ./bootstrap bench");
}

}  // namespace mars::launch
