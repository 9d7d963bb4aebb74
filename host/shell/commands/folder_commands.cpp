#include "host/shell/commands/folder_commands.h"

#include <functional>
#include <iostream>
#include <memory>
#include <string>

#include "host/shell/batch/folder_state.h"
#include "host/shell/batch/follow.h"
#include "host/shell/batch/state_text.h"
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

cli::Command add(cli::Command app, const char* name, const char* purpose,
                 const std::function<void(const std::string&)>& act) {
  const auto folder = std::make_shared<std::string>();
  const cli::Command command = app.add_command(name, purpose);
  command.add("DIR", *folder, "The folder given to mars render or mars submit with -o. Example: build/demo").required();
  command.runs([folder, act] { act(*folder); });
  return command;
}

// Like what a person reads, or one of the texts for programs.
struct StatusForm {
  bool json = false, metrics = false, comment = false;
};

void print_status(const std::string& folder, const StatusForm& form) {
  if (!form.json && !form.metrics && !form.comment) return print_state(folder);
  const batch::FolderState state = batch::look_at(folder);
  std::cout << (form.json ? batch::json_of(state) : form.metrics ? batch::metrics_of(state) : batch::comment_of(state));
}

void add_status(cli::Command app) {
  const auto form = std::make_shared<StatusForm>();
  const cli::Command command = add(app, "status", "Print the progress of the runs and jobs of a folder",
                                   [form](const std::string& folder) { print_status(folder, *form); });
  const cli::Option json = command.add_flag("--json", form->json, "Print one JSON object. Example: --json");
  const cli::Option metrics = command.add_flag(
      "--metrics", form->metrics, "Print metrics as OpenMetrics text, for a textfile collector. Example: --metrics");
  const cli::Option comment = command.add_flag("--comment", form->comment,
                                               "Print one line, for the comment of a batch job. Example: --comment");
  json.excludes(metrics).excludes(comment);
  metrics.excludes(comment);
}

}  // namespace

void add_folder_commands(cli::Command app, int& code) {
  add_status(app);
  add(app, "watch", "Follow the runs and jobs of a folder to their end",
      [&code](const std::string& folder) { code = watch(folder); });
  add(app, "cancel", "End the jobs that mars submit began for a folder", cancel);
}

}  // namespace mars::commands
