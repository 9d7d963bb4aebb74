// Command lines of the programs that render: a word a line, the first for which program.
#include <fcntl.h>
#include <unistd.h>

#include <string>
#include <vector>

#include "hal/failure/failure.h"
#include "host/shell/options/render_options.h"
#include "tests/fuzz/target.h"

namespace mars::fuzz::command_line {
namespace {

using options::Program;

constexpr Program kPrograms[] = {Program::host, Program::ranks, Program::threads, Program::simulated};

std::vector<std::string> lines_of(std::string_view input) {
  std::vector<std::string> lines;
  while (!input.empty()) {
    const std::size_t end = std::min(input.find('\n'), input.size());
    lines.emplace_back(input.substr(0, end));
    lines.back() = lines.back().c_str();  // a word of a command line has no zero
    input.remove_prefix(std::min(end + 1, input.size()));
  }
  return lines;
}

// While it lives, nothing is printed.
class Silence {
 public:
  Silence() {
    const int nothing = open("/dev/null", O_WRONLY | O_CLOEXEC);
    for (int stream = 1; stream <= 2; ++stream) {
      kept_[stream - 1] = fcntl(stream, F_DUPFD_CLOEXEC, 3);
      dup2(nothing, stream);
    }
    close(nothing);
  }
  ~Silence() {
    fflush(stdout);
    for (int stream = 1; stream <= 2; ++stream) {
      dup2(kept_[stream - 1], stream);
      close(kept_[stream - 1]);
    }
  }
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;

 private:
  int kept_[2];
};

std::optional<int> read(Program program, const std::vector<std::string>& words, options::RenderOptions& to) {
  std::vector<const char*> arguments{"mars"};
  for (const std::string& word : words) arguments.push_back(word.c_str());
  return options::read_render_options(program, "mars", "Renders.", to, static_cast<int>(arguments.size()),
                                      arguments.data());
}

}  // namespace

// What was understood is understood the same way by the program that is given it next.
void take(std::string_view input) {
  std::vector<std::string> words = lines_of(input);
  if (words.empty()) return;
  const Program program = kPrograms[words.front().size() % std::size(kPrograms)];
  words.erase(words.begin());
  const Silence silence;
  options::RenderOptions once, again;
  if (read(program, words, once)) return;
  const std::vector<std::string> handed_on = options::arguments_for(program, once);
  const auto ended = read(program, handed_on, again);
  check(!ended && handed_on == options::arguments_for(program, again), "options come through a command line");
}

const Target target("command_line", Form::text, take);

}  // namespace mars::fuzz::command_line
