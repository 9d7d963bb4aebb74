#include "host/shell/commands/verify_command.h"

#include <CLI/CLI.hpp>
#include <cstdint>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "host/content/film/frame_set.h"
#include "host/render/sinks/verify.h"
#include "host/shell/options/command_line.h"

namespace mars::commands {
namespace {

struct Words {
  std::string folder;
  bool missing = false;
};

// Exit code 0 in any case; prints nothing if no frame is missing.
void print_missing(const sinks::Verdict& verdict) {
  std::vector<std::uint32_t> frames;
  for (const sinks::Verdict::Trouble& trouble : verdict.troubles) frames.push_back(trouble.frame);
  if (!frames.empty()) std::cout << film::FrameSet(frames).text() << '\n';
}

// Returns the exit code.
int print_verdict(const sinks::Verdict& verdict) {
  for (const sinks::Verdict::Trouble& trouble : verdict.troubles)
    std::cout << "frame " << trouble.frame << ": " << trouble.reason << '\n';
  if (!verdict.troubles.empty()) {
    std::cout << verdict.troubles.size() << " of " << verdict.expected << " frames are missing or wrong\n";
    return options::kFailed;
  }
  std::cout << verdict.expected << " frames, all there";
  std::cout << (verdict.compared ? " and whole\n" : "; frames.json has no pixel hashes, so pixels were not compared\n");
  std::cout << "pixels (" << verdict.pixels << ") " << verdict.hash << '\n';
  return 0;
}

}  // namespace

void add_verify(CLI::App& app, int& code) {
  const auto words = std::make_shared<Words>();
  CLI::App* command = app.add_subcommand("verify", "Check every frame of a folder; print one hash of all pixels");
  command->add_option("DIR", words->folder, "The folder given to mars render with -o. Example: build/demo")->required();
  command->add_flag("--missing", words->missing,
                    "Print only the missing or wrong frames, in the form of --frames; nothing if there are none. "
                    "Example: --missing");
  command->footer(
      "To render the missing frames:\n"
      "  missing=$(mars verify DIR --missing)\n"
      "  [ -z \"$missing\" ] || mars render FILM -o DIR --frames \"$missing\"\n");
  command->callback([words, &code] {
    const sinks::Verdict verdict = sinks::verify_folder(words->folder);
    if (words->missing)
      print_missing(verdict);
    else
      code = print_verdict(verdict);
  });
}

}  // namespace mars::commands
