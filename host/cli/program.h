// How every program of MARS reads its command line and ends: 0 all went well, 1 something failed, 2 the
// command line itself is wrong (reported with what to type instead).
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "host/cli/command.h"

namespace mars::cli {

inline constexpr int kFailed = 1;
inline constexpr int kUsage = 2;
// These, for the end of a help.
inline constexpr const char* kExitCodes =
    "Exit codes: 0 success; 1 failure, reported on standard error; 2 wrong command\nline.\n";

// Owns all that is declared of its words.
class Program : public Command {
 public:
  Program(const std::string& name, const std::string& purpose);
  ~Program();
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  // What --version prints.
  void version(const std::string& text);

  // None: go on. Otherwise the exit code, everything already printed (0 after --help, --version and --list-options, and
  // after a command that only holds others: `mars model` prints its help).
  // --list-options is for manuals and completion (cluster/install/): lines of fields between tabs, none of them empty:
  //   command   NAME     PURPOSE                    the program and its commands: mars, mars model, mars model show
  //   argument  COMMAND  NAME   VALUE  NEED  HELP   NAME ends in ... where several may be; NEED is required or optional
  //   option    COMMAND  NAMES  VALUE  NEED  HELP   NAMES like -o,--output; VALUE is - where none is, X Y Z for three
  //   setting   NAME     MEANING                    of the environment
  std::optional<int> read(int argc, const char* const* argv);

  // The same of words after the program's name, from elsewhere than a command line: prints nothing, and throws Failure
  // where they are wrong.
  void read(const std::vector<std::string>& words);

  bool no_command_given() const;

 private:
  struct Declared {
    std::unique_ptr<CLI::App> app;
    Kept kept;
  };

  explicit Program(std::unique_ptr<Declared> declared);

  std::unique_ptr<Declared> declared_;
  CLI::App* app_;
};

}  // namespace mars::cli
