#include "host/shell/commands/calibrate_command.h"

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <array>
#include <cerrno>
#include <ctime>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>

#include "hal/failure/failure.h"
#include "host/child/environment.h"
#include "host/child/programs.h"
#include "host/content/document/whole_file.h"
#include "host/experiments/calibrate.h"
#include "host/experiments/platform.h"
#include "host/shell/launch/command.h"
#include "host/shell/launch/mpi_messages.h"
#include "topology/machine.h"
#include "topology/memory_limit.h"

namespace mars::commands {
namespace {

namespace fs = std::filesystem;

struct Words {
  std::string file;
  int repeats = 4;
};

// Empty at first, and removed at the end.
class WorkFolder {
 public:
  WorkFolder() {
    std::string name = child::temporary_folder(child::own_environment()) + "/mars-calibrate-XXXXXX";
    if (mkdtemp(name.data()) == nullptr) document::fail_file("make a folder", name, errno);
    path_ = name;
  }
  ~WorkFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  WorkFolder(const WorkFolder&) = delete;
  WorkFolder& operator=(const WorkFolder&) = delete;

  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

fs::path renderer() {
  const auto program = launch::find_programs(child::own_file(), child::program_path(child::own_environment())).threads;
  if (!program) throw Failure("mars-threads is not installed", "", "install all of MARS");
  return *program;
}

experiments::CalibratedMachine this_machine(const fs::path& file) {
  char name[256] = {};
  gethostname(name, sizeof name - 1);
  char day[32] = {};
  const std::time_t now = std::time(nullptr);
  std::strftime(day, sizeof day, "%F", std::localtime(&now));
  const topology::Machine machine = topology::Machine::here();
  const int processors = machine.processors();
  return {file.stem().string(),
          std::string(name) + ", measured by mars calibrate of MARS " MARS_VERSION " on " + day + ".", processors,
          topology::memory_share(machine.memory(), topology::memory_limit(), processors)};
}

void show_progress(int done, int all) {
  if (isatty(STDERR_FILENO)) std::cerr << "\rmeasuring: " << 100 * done / all << " %" << (done == all ? "\n" : "");
}

void calibrate(const Words& words, const MeasureMessages& measure_messages) {
  const fs::path file = words.file.empty() ? experiments::calibrated_platform() : fs::path(words.file);
  if (words.file.empty()) fs::create_directories(file.parent_path());
  document::check_can_write(file);
  const auto over_mpi = launch::mpi_message_costs(child::own_file());
  const experiments::MessageCosts messages = over_mpi ? *over_mpi : measure_messages();
  const WorkFolder folder;
  const experiments::Calibration calibration =
      experiments::calibrate({renderer(), folder.path(), words.repeats, show_progress});
  std::cout << experiments::table_text(calibration);
  if (calibration.spread > experiments::kMostSpread)
    std::cout << "\nThe machine was too busy: repeats took " << static_cast<int>(100 * calibration.spread)
              << " % longer than the shortest. Calibrate again when nothing else runs.\n";
  document::write_whole_file(file, experiments::platform_text(calibration, messages, this_machine(file)));
  std::cout << "\nwritten to " << file.string() << '\n';
}

}  // namespace

void add_calibrate(CLI::App& app, const MeasureMessages& measure_messages) {
  const auto words = std::make_shared<Words>();
  CLI::App* command =
      app.add_subcommand("calibrate", "Measure what work costs on this machine, for simulated renderings");
  command
      ->add_option("-o", words->file,
                   "Write the platform to FILE; default: your own, which --platform here reads. Example: -o lab.json")
      ->check([](const std::string& file) { return std::string(file.empty() ? "names no file" : ""); }, "")
      ->type_name("FILE");
  command
      ->add_option("--repeats", words->repeats,
                   "Render each film N times; the shortest times count. Default: 4. Example: --repeats 10")
      ->check(CLI::Range(1, 1000).description(""))
      ->type_name("N");
  command->footer(
      "It takes 10 to 30 seconds, in which nothing else should run. Then:\n"
      "  mars render FILM --sink none --backend simulated --platform here --nodes 4\n"
      "  mars render FILM --sink none --backend simulated --platform fat-tree:here ...\n");
  command->callback([words, measure_messages] { calibrate(*words, measure_messages); });
}

}  // namespace mars::commands
