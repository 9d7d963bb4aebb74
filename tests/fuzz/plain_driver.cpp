// Where libFuzzer is not: one program of all targets. It gives a target its corpus, then inputs changed at random from
// those, always the same with one seed. A finding leaves its input in a file, which replays it: by default below the
// build's folder.
//   fuzz-targets                               lists the targets
//   fuzz-targets TARGET [--seconds N] [--runs N] [--seed N] [--crash FILE] [--show] [CORPUS | INPUT] ...
//   fuzz-targets --replay FOLDER [TARGET ...]  gives all targets, or these, their corpora, FOLDER/TARGET
// --show prints why inputs of the corpus are refused.
#include <fcntl.h>
#include <signal.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "tests/fuzz/mutation.h"
#include "tests/fuzz/target.h"

extern "C" [[gnu::weak]] void __sanitizer_set_death_callback(void (*callback)());

namespace mars::fuzz {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr long kLongestRun = 60;  // seconds of processor time of some inputs

struct Input {
  std::string name;
  std::string text;
};

struct Wanted {
  explicit Wanted(const Target& target) : target(&target), crash(MARS_FUZZ_FINDINGS "/crash-" + target.name) {}

  const Target* target;
  double seconds = 0;
  std::uint64_t runs = 0;
  std::uint64_t seed = 1;
  std::string crash;  // where a finding goes
  bool show = false;
  std::vector<Input> corpus;
};

const Wanted* running = nullptr;
const Input* current = nullptr;  // which is being taken

// As signal handlers must: by system calls alone.
void keep_input() {
  if (current == nullptr) return;
  const char* const crash = running->crash.c_str();
  const std::string& input = current->text;
  const int file = open(crash, O_WRONLY | O_CREAT | O_TRUNC, 0666);
  const bool kept = write(file, input.data(), input.size()) == static_cast<ssize_t>(input.size());
  const char* const words = kept ? ": the input is in " : ": the input cannot be written to ";
  for (const char* text : {"\n", running->target->name.c_str(), ", ", current->name.c_str(), words, crash, "\n"})
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

std::string run_one(const Input& input) {
  current = &input;
  const std::string refusal = run(*running->target, input.text);
  current = nullptr;
  return refusal;
}

std::string read(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

void add_corpus(const fs::path& place, std::vector<Input>& inputs) {
  if (!fs::is_directory(place)) return inputs.push_back({place.filename(), read(place)});
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(place)) files.push_back(entry.path());
  std::ranges::sort(files);
  for (const fs::path& file : files) inputs.push_back({file.filename(), read(file)});
}

Wanted read_words(const Target& target, std::span<char*> words) {
  Wanted wanted(target);
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string word = words[i];
    const auto value = [&] { return i + 1 < words.size() ? words[++i] : "0"; };
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
      add_corpus(word, wanted.corpus);
  }
  return wanted;
}

double seconds_since(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

// The clock is read, and the time of inputs limited, only now and then. What is left of a short input is often nothing,
// one input that the corpus has where it says something.
void mutate(const Wanted& wanted, Clock::time_point begin) {
  Mutation mutation(wanted.seed);
  const bool of_text = wanted.target->form == Form::text;
  const auto some_text = [&]() -> const std::string& {
    return wanted.corpus[mutation.below(wanted.corpus.size())].text;
  };
  Input input{"changed at random", some_text()};
  std::string& text = input.text;
  for (std::uint64_t i = 0; i < wanted.runs || wanted.runs == 0; ++i) {
    if (i % 16 == 0) limit_time();
    if (wanted.seconds > 0 && i % 16 == 0 && seconds_since(begin) > wanted.seconds) break;
    if (mutation.below(8) > 0) text = some_text();  // else changed further
    do text = of_text ? mutation.of_text(text, some_text()) : mutation.of_bytes(text, some_text());
    while (text.empty());
    run_one(input);
  }
}

int give_inputs(Wanted wanted) {
  running = &wanted;
  catch_ends();
  const auto begin = Clock::now();
  if (wanted.corpus.empty()) wanted.corpus.push_back({"nothing", ""});
  for (const Input& input : wanted.corpus) {
    limit_time();
    const std::string refusal = run_one(input);
    if (wanted.show) std::printf("%s: %s\n", input.name.c_str(), refusal.empty() ? "taken" : refusal.c_str());
  }
  if (wanted.seconds > 0 || wanted.runs > 0) mutate(wanted, begin);
  const auto all = static_cast<double>(counts().taken + counts().refused);
  std::printf("%.0f executions, %.0f a second, %.0f %% of them refused\n", all, all / seconds_since(begin),
              100 * static_cast<double>(counts().refused) / all);
  return 0;
}

// Whether nothing was found. The target has a process of its own, which a finding ends.
bool replay_apart(const Target& target, const fs::path& corpus) {
  std::printf("%s: ", target.name.c_str());
  std::fflush(stdout);
  const pid_t process = fork();
  if (process == 0) {
    Wanted wanted(target);
    add_corpus(corpus, wanted.corpus);
    std::exit(give_inputs(std::move(wanted)));
  }
  int status = 1;
  return process > 0 && waitpid(process, &status, 0) == process && status == 0;
}

int replay_all(const fs::path& folder, std::span<const Target* const> targets) {
  std::string found;
  for (const Target* target : targets) {
    const fs::path corpus = folder / target->name;
    const bool has_corpus = fs::is_directory(corpus) && !fs::is_empty(corpus);
    if (!has_corpus) std::fprintf(stderr, "there is no corpus %s\n", corpus.c_str());
    if (!has_corpus || !replay_apart(*target, corpus)) found += " " + target->name;
  }
  if (!found.empty()) std::fprintf(stderr, "targets that failed:%s\n", found.c_str());
  return found.empty() ? 0 : 1;
}

// Null, with a word, where no target has the name.
const Target* find_target(std::string_view name) {
  const std::vector<const Target*> targets = all_targets();
  const auto found = std::ranges::find(targets, name, &Target::name);
  if (found != targets.end()) return *found;
  std::fprintf(stderr, "no target is called %.*s\n", static_cast<int>(name.size()), name.data());
  return nullptr;
}

int replay(std::span<char*> words) {
  std::vector<const Target*> targets;
  for (const char* name : words.subspan(1)) targets.push_back(find_target(name));
  if (std::ranges::count(targets, nullptr) > 0) return 2;
  return replay_all(words.front(), targets.empty() ? all_targets() : targets);
}

int drive(std::span<char*> words) {
  if (words.empty()) {
    for (const Target* target : all_targets()) std::puts(target->name.c_str());
    return 0;
  }
  if (words.front() == std::string_view("--replay") && words.size() > 1) return replay(words.subspan(1));
  const Target* const target = find_target(words.front());
  return target == nullptr ? 2 : give_inputs(read_words(*target, words.subspan(1)));
}

}  // namespace
}  // namespace mars::fuzz

int main(int argc, char** argv) {
  return mars::fuzz::drive(std::span(argv, static_cast<std::size_t>(argc)).subspan(1));
}
