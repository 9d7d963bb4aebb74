// Where libFuzzer is not: replays a target's corpus, then gives it inputs changed at random from those, always the same
// with one seed. A finding leaves its input in a file, which replays it: by default below the build's folder.
//   TARGET [--seconds N] [--runs N] [--seed N] [--crash FILE] [--show] [CORPUS | INPUT] ...
// --show prints why inputs of the corpus are refused.
#include <fcntl.h>
#include <signal.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

#include "tests/fuzz/mutation.h"
#include "tests/fuzz/target.h"

extern "C" [[gnu::weak]] void __sanitizer_set_death_callback(void (*callback)());

namespace mars::fuzz {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr long kLongestRun = 60;  // seconds of processor time of some inputs

struct Wanted {
  double seconds = 0;
  std::uint64_t runs = 0;
  std::uint64_t seed = 1;
  std::string crash;  // where a finding goes
  bool show = false;
  struct Input {
    std::string name;
    std::string text;
  };
  std::vector<Input> inputs;  // the corpus
};

const std::string* current = nullptr;  // the input that is being taken
const char* crash_file = "";

// As signal handlers must: by system calls alone.
void keep_input() {
  if (current == nullptr) return;
  const int file = open(crash_file, O_WRONLY | O_CREAT | O_TRUNC, 0666);
  const bool kept = write(file, current->data(), current->size()) == static_cast<ssize_t>(current->size());
  const char* const words = kept ? "\nthe input is in " : "\nthe input cannot be written to ";
  for (const char* text : {words, crash_file, "\n"})
    if (write(STDERR_FILENO, text, std::strlen(text)) < 0) break;
  current = nullptr;
}

void end_by(int signal) {
  keep_input();
  ::signal(signal, SIG_DFL);
  raise(signal);
}

void catch_ends() {
  signal(SIGABRT, end_by);
  signal(SIGPROF, end_by);
  if (__sanitizer_set_death_callback != nullptr) return __sanitizer_set_death_callback(keep_input);
  for (const int crash : {SIGSEGV, SIGBUS, SIGFPE, SIGILL}) signal(crash, end_by);
}

void limit_time() {
  const itimerval limit{{}, {kLongestRun, 0}};
  setitimer(ITIMER_PROF, &limit, nullptr);
}

std::string run_one(const std::string& input) {
  current = &input;
  const std::string refusal = run(input);
  current = nullptr;
  return refusal;
}

std::string read(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

void add_corpus(const fs::path& place, std::vector<Wanted::Input>& inputs) {
  if (!fs::is_directory(place)) return inputs.push_back({place.filename(), read(place)});
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(place)) files.push_back(entry.path());
  std::ranges::sort(files);
  for (const fs::path& file : files) inputs.push_back({file.filename(), read(file)});
}

Wanted read_words(int argc, char** argv) {
  Wanted wanted;
  wanted.crash = MARS_FUZZ_FINDINGS "/crash-" + fs::path(argv[0]).filename().string();
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    const auto value = [&] { return i + 1 < argc ? argv[++i] : "0"; };
    if (word == "--seconds")
      wanted.seconds = std::atof(value());
    else if (word == "--runs")
      wanted.runs = std::strtoull(value(), nullptr, 10);
    else if (word == "--seed")
      wanted.seed = std::strtoull(value(), nullptr, 10);
    else if (word == "--show")
      wanted.show = true;
    else if (word == "--crash")
      wanted.crash = value();
    else
      add_corpus(word, wanted.inputs);
  }
  return wanted;
}

double seconds_since(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

// The clock is read, and the time of inputs limited, only now and then. What is left of a short input is often nothing,
// one input that the corpus has where it says something.
void mutate(const Wanted& wanted, Clock::time_point begin) {
  Mutation mutation(wanted.seed);
  const auto some_input = [&]() -> const std::string& {
    return wanted.inputs[mutation.below(wanted.inputs.size())].text;
  };
  std::string input = some_input();
  for (std::uint64_t i = 0; i < wanted.runs || wanted.runs == 0; ++i) {
    if (i % 16 == 0) limit_time();
    if (wanted.seconds > 0 && i % 16 == 0 && seconds_since(begin) > wanted.seconds) break;
    if (mutation.below(8) > 0) input = some_input();  // else changed further
    do input = kForm == Form::text ? mutation.of_text(input, some_input()) : mutation.of_bytes(input, some_input());
    while (input.empty());
    run_one(input);
  }
}

int drive(int argc, char** argv) {
  Wanted wanted = read_words(argc, argv);
  crash_file = wanted.crash.c_str();
  catch_ends();
  const auto begin = Clock::now();
  if (wanted.inputs.empty()) wanted.inputs.push_back({"nothing", ""});
  for (const auto& [name, text] : wanted.inputs) {
    limit_time();
    const std::string refusal = run_one(text);
    if (wanted.show) std::printf("%s: %s\n", name.c_str(), refusal.empty() ? "taken" : refusal.c_str());
  }
  if (wanted.seconds > 0 || wanted.runs > 0) mutate(wanted, begin);
  const auto all = static_cast<double>(counts().taken + counts().refused);
  std::printf("%.0f executions, %.0f a second, %.0f %% of them refused\n", all, all / seconds_since(begin),
              100 * static_cast<double>(counts().refused) / all);
  return 0;
}

}  // namespace
}  // namespace mars::fuzz

int main(int argc, char** argv) { return mars::fuzz::drive(argc, argv); }
