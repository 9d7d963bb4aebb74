#include "host/shell/commands/bench_command.h"

#include <iostream>
#include <memory>
#include <string>
#include <string_view>

#include "host/child/programs.h"
#include "host/cli/command.h"
#include "host/shell/launch/bench.h"

namespace mars::commands {
namespace {

struct BenchWords {
  std::string name;
  std::vector<std::string> own;  // of the benchmark
};

std::vector<std::string> take_own_words(std::vector<const char*>& words) {
  constexpr std::size_t kName = 2;  // "mars bench NAME"
  if (words.size() <= kName + 1 || std::string_view(words[1]) != "bench" || words[kName][0] == '-') return {};
  std::vector<std::string> own(words.begin() + kName + 1, words.end());
  words.resize(kName + 1);
  return own;
}

void bench(const BenchWords& words) {
  if (words.name.empty())
    std::cout << launch::list_benchmarks(child::own_file());
  else
    launch::run_benchmark(child::own_file(), words.name, words.own);
}

}  // namespace

void add_bench(cli::Command app, std::vector<const char*>& command_line) {
  const auto words = std::make_shared<BenchWords>();
  words->own = take_own_words(command_line);
  const cli::Command command = app.add_command("bench", "Run a benchmark, or list them");
  command.add("NAME", words->name, "The benchmark; the words after it are its own. Example: peers --scenes s1");
  command.footer("mars bench NAME --help prints the benchmark's own options.\n");
  command.runs([words] { bench(*words); });
}

}  // namespace mars::commands
