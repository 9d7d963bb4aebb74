// The words of a command line, as the programs of MARS declare them: commands within commands, each with arguments,
// options and flags. The library that reads them is known to this folder alone.
#pragma once

#include <cstdint>
#include <functional>
#include <initializer_list>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace mars::cli {

// The command line itself is wrong, which ends a program with kUsage: at `word`, an option or argument.
class UsageError : public std::runtime_error {
 public:
  UsageError(const std::string& word, const std::string& problem) : std::runtime_error(word + ": " + problem) {}
};

// A handle of one argument, option or flag, which its program owns.
class Option {
 public:
  explicit Option(CLI::Option& option) : option_(&option) {}

  Option required() const;
  // The name of its value in helps: "FILE", "X Y Z".
  Option type(const std::string& name) const;
  // Beginnings of its words that shells complete.
  Option offers(const std::vector<std::string>& beginnings) const;
  // How many words it takes.
  Option words(int count) const { return words(count, count); }
  Option words(int least, int most) const;
  // It may be given several times, with one value each time.
  Option repeated() const;
  Option range(int least, int most) const;
  Option range(std::uint32_t least, std::uint32_t most) const;
  Option range(std::int64_t least, std::int64_t most) const;
  Option range(double least, double most) const;
  Option one_of(const std::vector<std::string>& choices) const;
  // `problem_of`: what is wrong with a word; "" where nothing is.
  Option check(const std::function<std::string(const std::string& word)>& problem_of) const;
  Option excludes(Option other) const;
  Option needs(Option other) const;
  Option hidden() const;                           // not in the help
  Option under(const std::string& heading) const;  // of the help

  // How often it was, by what was read.
  std::size_t times_given() const;
  bool given() const { return times_given() > 0; }

  // For who lists them.
  std::string name() const;       // "-o,--output", "FILM"
  std::string type_name() const;  // "" of a flag
  std::string help() const;

 private:
  CLI::Option* option_;
};

// A handle of a command, which its program owns.
class Command {
 public:
  using Kept = std::vector<std::shared_ptr<void>>;

  Command(CLI::App& app, Kept& kept) : app_(&app), kept_(&kept) {}

  Command add_command(const std::string& name, const std::string& purpose) const;

  // `names`: "-o,--output" of an option, "FILM" of an argument. What is typed goes to `value`, which must outlive the
  // reading; a help ends in "Example: ...".
  template <typename Value>
  Option add(const std::string& names, Value& value, const std::string& help) const;
  Option add_flag(const std::string& names, bool& value, const std::string& help) const;
  // `read` takes the word that is typed; a Failure that it throws is a UsageError of this option.
  Option add_read(const std::string& names, const std::function<void(const std::string& word)>& read,
                  const std::string& help) const;
  Option add_read(const std::string& names, const std::function<void(const std::vector<double>& numbers)>& read,
                  const std::string& help) const;
  // Its words stand for 0, 1, 2 ...
  Option add_choice(const std::string& name, const std::vector<std::string>& words,
                    const std::function<void(std::size_t number)>& take, const std::string& help) const;

  Command footer(const std::string& text) const;  // of its help, and of those of commands added later
  // After all words are read and known, once for each command: may throw UsageError, or Failure, which is one of this
  // command.
  void checks(const std::function<void()>& check) const;
  // Calls `run` when the command was given and all words make sense.
  void runs(const std::function<void()>& run) const;
  // Until its program goes.
  void keeps(const std::shared_ptr<void>& typed) const { kept_->push_back(typed); }

  std::string name() const;
  Option option(const std::string& name) const;  // that it has
  bool given(const std::string& name) const { return option(name).given(); }
  // The first of `names` that it has and that was given; "": none.
  std::string first_given(std::initializer_list<std::string_view> names) const;
  std::vector<Option> options() const;  // and arguments, but for --help and hidden ones
  std::vector<Command> commands() const;

 private:
  CLI::App* app_;
  Kept* kept_;
};

}  // namespace mars::cli
