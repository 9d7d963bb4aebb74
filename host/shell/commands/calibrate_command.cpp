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
#include "host/cli/command.h"
#include "host/content/document/text.h"
#include "host/content/document/whole_file.h"
#include "host/experiments/calibrate.h"
#include "host/experiments/platform.h"
#include "host/experiments/trials/trials.h"
#include "host/shell/commands/shown_progress.h"
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
  int trials = 39;  // films; two of them lie beyond either end of nine in ten
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

// Where what --platform here names is written, in a folder that is there.
fs::path file_of_here() {
  const fs::path file = experiments::calibrated_platform();
  if (file.is_relative())
    throw Failure("there is no folder of yours to keep a calibration in", "", "set HOME, or give a file with -o");
  fs::create_directories(file.parent_path());
  return file;
}

// A machine is measured, then forecasts by its costs are tried.
class Measuring {
 public:
  explicit Measuring(const NodesCode& code) : code_(code) {}

  void measure(int repeats) {
    const auto over_mpi = launch::mpi_message_costs(child::own_file());
    messages_ = over_mpi ? *over_mpi : code_.measure_messages();
    calibration_ = experiments::calibrate({renderer_, repeats, shown_progress("measuring")});
  }
  void try_forecasts(int films) {
    const fs::path file = folder_.path() / "platform.json";
    write(file);
    const experiments::Platform platform = experiments::read_platform(file, folder_.path());
    calibration_.spread = trials::try_forecasts(
        {trials::trial_films(films), renderer_, platform, code_.make_counter, shown_progress("trying forecasts")});
  }
  void write(const fs::path& file) const {
    document::write_whole_file(file, experiments::platform_text(calibration_, messages_, this_machine(file)));
  }
  const experiments::Calibration& calibration() const { return calibration_; }

 private:
  const NodesCode& code_;
  const WorkFolder folder_;
  const experiments::Renderer renderer_{renderer(), folder_.path()};
  experiments::Calibration calibration_;
  experiments::MessageCosts messages_;
};

void calibrate(const CalibrateWords& words, const NodesCode& code) {
  const fs::path file = words.file.empty() ? file_of_here() : fs::path(words.file);
  document::check_can_write(file);
  Measuring measuring(code);
  measuring.measure(words.repeats);
  if (words.trials > 0) measuring.try_forecasts(words.trials);
  std::cout << experiments::table_text(measuring.calibration());
  if (const std::string& doubt = measuring.calibration().doubt; !doubt.empty())
    std::cout << "\nThe machine was too busy: " << doubt
              << (words.trials > 0 ? ". Intervals of forecasts are the wider for it" : "")
              << ". Calibrate again when nothing else runs.\n";
  measuring.write(file);
  std::cout << "\nwritten to " << file.string() << '\n';
}

// Fewer repeats and trials than mars calibrate has: a person waits for something else.
constexpr int kFewRepeats = 3;

// Why it cannot; "": it has.
std::string calibrate_unasked(const NodesCode& code) try {
  const fs::path file = file_of_here();
  document::check_can_write(file);
  if (const std::string busy = experiments::doubt_of(experiments::busyness()); !busy.empty()) return busy;
  std::cerr << "mars: this machine is not calibrated: it is measured now, for about a minute\n";
  Measuring measuring(code);
  measuring.measure(kFewRepeats);
  if (const std::string& doubt = measuring.calibration().doubt; !doubt.empty()) return doubt;
  measuring.try_forecasts(experiments::kFewestTrials);
  measuring.write(file);
  std::cerr << "mars: kept in " << file.string() << "; mars calibrate measures again\n";
  return "";
} catch (const std::exception& failure) {
  return reason_of(failure);
}

// "": nothing is.
std::string wrong_trials(const std::string& word) {
  constexpr int kMost = 1000;
  const auto number = document::number_in<int>(word);
  const bool right = number && (*number == 0 || (*number >= experiments::kFewestTrials && *number <= kMost));
  return right ? "" : document::formatted("is neither 0 nor a number from %d to %d", experiments::kFewestTrials, kMost);
}

// By this version of MARS.
bool is_calibrated() {
  if (!fs::exists(experiments::calibrated_platform())) return false;
  try {
    experiments::read_platform("here", experiments::platforms_folder(child::own_file()));
    return true;
  } catch (const Failure& failure) {
    std::cerr << "mars: " << failure.what() << '\n';
    return false;
  }
}

}  // namespace

bool calibrate_if_need_be(const NodesCode& code) {
  if (is_calibrated()) return true;
  const std::string trouble = calibrate_unasked(code);
  if (!trouble.empty())
    std::cerr << "mars: warning: this machine is not calibrated, and cannot be now: " << trouble
              << "; costs are those of the reference machine (run mars calibrate when nothing else runs)\n";
  return trouble.empty();
}

void add_calibrate(cli::Command app, const NodesCode& code) {
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
  command
      .add("--trials", words->trials,
           "Try forecasts on N films, from which come their intervals: at least 19, or 0 for none. Default: 39. "
           "Example: --trials 79")
      .check(wrong_trials)
      .type("N");
  command.footer(
      "It takes one to two minutes, in which nothing else should run. Then:\n"
      "  mars render FILM --sink none --backend simulated --platform here --nodes 4\n"
      "  mars render FILM --sink none --backend simulated --platform fat-tree:here ...\n");
  command.runs([words, code] { calibrate(*words, code); });
}

}  // namespace mars::commands
