#include "host/shell/commands/calibrate_command.h"

#include <unistd.h>

#include <array>
#include <cerrno>
#include <ctime>
#include <exception>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>

#include "hal/failure/explain.h"
#include "hal/failure/failure.h"
#include "host/child/environment.h"
#include "host/child/programs.h"
#include "host/child/standard_streams.h"
#include "host/cli/command.h"
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

struct CalibrateWords {
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
  if (isatty(STDERR_FILENO))
    child::raw_error() << "\rmeasuring: " << 100 * done / all << " %" << (done == all ? "\n" : "");
}

// Where what --platform here names is written, in a folder that is there.
fs::path file_of_here() {
  const fs::path file = experiments::calibrated_platform();
  if (file.is_relative())
    throw Failure("there is no folder of yours to keep a calibration in", "", "set HOME, or give a file with -o");
  fs::create_directories(file.parent_path());
  return file;
}

struct Measured {
  experiments::Calibration calibration;
  experiments::MessageCosts messages;
};

Measured measure(int repeats, const MeasureMessages& measure_messages) {
  const auto over_mpi = launch::mpi_message_costs(child::own_file());
  const experiments::MessageCosts messages = over_mpi ? *over_mpi : measure_messages();
  const WorkFolder folder;
  return {experiments::calibrate({renderer(), folder.path(), repeats, show_progress}), messages};
}

void write(const fs::path& file, const Measured& measured) {
  document::write_whole_file(file,
                             experiments::platform_text(measured.calibration, measured.messages, this_machine(file)));
}

void calibrate(const CalibrateWords& words, const MeasureMessages& measure_messages) {
  const fs::path file = words.file.empty() ? file_of_here() : fs::path(words.file);
  document::check_can_write(file);
  const Measured measured = measure(words.repeats, measure_messages);
  std::cout << experiments::table_text(measured.calibration);
  if (const std::string& doubt = measured.calibration.doubt; !doubt.empty())
    std::cout << "\nThe machine was too busy: " << doubt << ". Calibrate again when nothing else runs.\n";
  write(file, measured);
  std::cout << "\nwritten to " << file.string() << '\n';
}

// Fewer repeats than mars calibrate has: a person waits for something else.
constexpr int kFewRepeats = 3;

// Why it cannot; "": it has.
std::string calibrate_unasked(const MeasureMessages& measure_messages) try {
  const fs::path file = file_of_here();
  document::check_can_write(file);
  if (const std::string busy = experiments::doubt_of(experiments::busyness()); !busy.empty()) return busy;
  std::cerr << "mars: this machine is not calibrated: it is measured now, for some 10 seconds\n";
  const Measured measured = measure(kFewRepeats, measure_messages);
  if (!measured.calibration.doubt.empty()) return measured.calibration.doubt;
  write(file, measured);
  std::cerr << "mars: kept in " << file.string() << "; mars calibrate measures again\n";
  return "";
} catch (const std::exception& failure) {
  return reason_of(failure);
}

}  // namespace

bool calibrate_if_need_be(const MeasureMessages& measure_messages) {
  if (fs::exists(experiments::calibrated_platform())) return true;
  const std::string trouble = calibrate_unasked(measure_messages);
  if (!trouble.empty())
    std::cerr << "mars: warning: this machine is not calibrated, and cannot be now: " << trouble
              << "; costs are those of the reference machine (run mars calibrate when nothing else runs)\n";
  return trouble.empty();
}

void add_calibrate(cli::Command app, const MeasureMessages& measure_messages) {
  const auto words = std::make_shared<CalibrateWords>();
  const cli::Command command =
      app.add_command("calibrate", "Measure what work costs on this machine, for simulated renderings");
  command
      .add("-o", words->file,
           "Write the platform to FILE; default: your own, which --platform here reads. Example: -o lab.json")
      .check([](const std::string& file) { return std::string(file.empty() ? "names no file" : ""); })
      .type("FILE");
  command
      .add("--repeats", words->repeats,
           "Render each film N times; the shortest times count. Default: 4. Example: --repeats 10")
      .range(1, 1000)
      .type("N");
  command.footer(
      "It takes 10 to 30 seconds, in which nothing else should run. Then:\n"
      "  mars render FILM --sink none --backend simulated --platform here --nodes 4\n"
      "  mars render FILM --sink none --backend simulated --platform fat-tree:here ...\n");
  command.runs([words, measure_messages] { calibrate(*words, measure_messages); });
}

}  // namespace mars::commands
