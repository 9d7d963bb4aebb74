#include "host/shell/commands/folder_commands.h"

#include <functional>
#include <iostream>
#include <memory>
#include <string>

#include "host/shell/batch/folder_state.h"
#include "host/shell/batch/follow.h"
#include "host/cli/program.h"

namespace mars::commands {
namespace {

void print_state(const std::string& folder) {
  for (const std::string& line : batch::lines_of(batch::look_at(folder), true)) std::cout << line << '\n';
}

// Returns the exit code.
int watch(const std::string& folder) {
  if (batch::follow(folder)) return 0;
  std::cerr << "mars: " << folder << ": nothing renders here, and frames are missing (give mars render or mars submit "
            << "the film and this folder to go on)\n";
  return cli::kFailed;
}

void cancel(const std::string& folder) {
  batch::cancel(folder);
  print_state(folder);
}

void add(cli::Command app, const char* name, const char* purpose, const std::function<void(const std::string&)>& act) {
  const auto folder = std::make_shared<std::string>();
  const cli::Command command = app.add_command(name, purpose);
  command.add("DIR", *folder, "The folder given to mars render or mars submit with -o. Example: build/demo").required();
  command.runs([folder, act] { act(*folder); });
}

}  // namespace

void add_folder_commands(cli::Command app, int& code) {
  add(app, "status", "Print the progress of the runs and jobs of a folder", print_state);
  add(app, "watch", "Follow the runs and jobs of a folder to their end",
      [&code](const std::string& folder) { code = watch(folder); });
  add(app, "cancel", "End the jobs that mars submit began for a folder", cancel);
}

}  // namespace mars::commands
