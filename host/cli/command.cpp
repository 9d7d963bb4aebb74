#include "host/cli/command.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <limits>
#include <type_traits>
#include <utility>

#include "hal/failure/failure.h"
#include "host/content/document/text.h"

namespace mars::cli {
namespace {

template <typename Number>
std::string written(Number number) {
  if constexpr (std::is_floating_point_v<Number>)
    return document::shown(number);
  else
    return std::to_string(number);
}

// Says what is wrong with a word that is to be such a number, in place of the library's words for it.
template <typename Number>
std::string problem_of_number(const std::string& word) {
  using Limits = std::numeric_limits<Number>;
  Number number{};
  std::int64_t whole = 0;
  if (CLI::detail::lexical_cast(word, number)) return "";
  if constexpr (std::is_floating_point_v<Number>) return document::in_quotes(word) + " is no number";
  if (!CLI::detail::lexical_cast(word, whole)) return document::in_quotes(word) + " is no whole number";
  return document::in_quotes(word) + " is not from " + written(Limits::lowest()) + " to " + written(Limits::max());
}

template <typename Number>
Option limited(CLI::Option& option, Number least, Number most) {
  const auto problem_of = [=](const std::string& word) {
    Number number{};
    const bool fits = CLI::detail::lexical_cast(word, number) && number >= least && number <= most;
    return fits ? "" : document::in_quotes(word) + " is no number from " + written(least) + " to " + written(most);
  };
  return Option(*option.check(problem_of, ""));
}

// The kind of value as which each word of an option is read.
template <typename Value>
struct WordOf {
  using Type = Value;
};
template <typename Value>
struct WordOf<std::optional<Value>> : WordOf<Value> {};
template <typename Value>
struct WordOf<std::vector<Value>> : WordOf<Value> {};

// An option's text may be empty: it is then as if it were not given. No number is.
template <typename Value>
constexpr bool kIsText = std::is_constructible_v<Value, std::string> || std::is_same_v<Value, std::vector<std::string>>;

std::string is_empty(const std::string& word) { return word.empty() ? "is empty" : ""; }

// A Failure in `check` is one of the command line, at `word`.
template <typename Check>
void as_usage(const std::string& word, Check check) {
  try {
    check();
  } catch (const Failure& failure) {
    throw UsageError(word, failure.what());
  }
}

}  // namespace

Option Option::required() const { return Option(*option_->required()); }

Option Option::type(const std::string& name) const { return Option(*option_->type_name(name)); }

Option Option::offers(const std::vector<std::string>& beginnings) const {
  option_->option_text(option_->get_items_expected_max() > 1 ? "..." : "");
  return type(document::joined(beginnings, "|"));
}

Option Option::words(int least, int most) const {
  if (least != most) return Option(*option_->expected(least, most));
  return Option(*option_->expected(least)->allow_extra_args(false));
}

Option Option::repeated() const {
  option_->expected(1)->allow_extra_args(false)->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  return *this;
}

Option Option::range(int least, int most) const { return limited(*option_, least, most); }

Option Option::range(std::uint32_t least, std::uint32_t most) const { return limited(*option_, least, most); }

Option Option::range(std::int64_t least, std::int64_t most) const { return limited(*option_, least, most); }

Option Option::range(double least, double most) const { return limited(*option_, least, most); }

Option Option::one_of(const std::vector<std::string>& choices) const {
  return check([choices](const std::string& word) {
    const bool known = std::ranges::find(choices, word) != choices.end();
    return known ? "" : document::in_quotes(word) + " is none of " + document::joined(choices);
  });
}

Option Option::check(const std::function<std::string(const std::string& word)>& problem_of) const {
  return Option(*option_->check([problem_of](const std::string& word) { return problem_of(word); }, ""));
}

Option Option::excludes(Option other) const { return Option(*option_->excludes(other.option_)); }

Option Option::needs(Option other) const { return Option(*option_->needs(other.option_)); }

Option Option::hidden() const { return Option(*option_->group("")); }

Option Option::under(const std::string& heading) const { return Option(*option_->group(heading)); }

std::size_t Option::times_given() const { return option_->count(); }

std::string Option::name() const { return option_->get_name(false, true); }

std::string Option::type_name() const { return option_->get_type_size() == 0 ? "" : option_->get_type_name(); }

std::string Option::help() const { return option_->get_description(); }

Command Command::add_command(const std::string& name, const std::string& purpose) const {
  return {*app_->add_subcommand(name, purpose), *kept_};
}

template <typename Value>
Option Command::add(const std::string& names, Value& value, const std::string& help) const {
  using Word = typename WordOf<Value>::Type;
  const Option option(*app_->add_option(names, value, help));
  if constexpr (std::is_arithmetic_v<Word>) return option.check(is_empty).check(problem_of_number<Word>);
  return names.starts_with('-') && kIsText<Value> ? option : option.check(is_empty);
}

#define MARS_VALUE(...) template Option Command::add(const std::string&, __VA_ARGS__&, const std::string&) const
MARS_VALUE(std::string);
MARS_VALUE(std::optional<std::string>);
MARS_VALUE(std::vector<std::string>);
MARS_VALUE(std::filesystem::path);
MARS_VALUE(int);
MARS_VALUE(std::optional<int>);
MARS_VALUE(std::optional<std::uint16_t>);
MARS_VALUE(std::optional<std::uint32_t>);
MARS_VALUE(std::uint32_t);
MARS_VALUE(std::int64_t);
MARS_VALUE(std::uint64_t);
MARS_VALUE(double);
MARS_VALUE(std::optional<double>);
MARS_VALUE(std::vector<double>);
MARS_VALUE(std::vector<std::uint64_t>);
MARS_VALUE(std::vector<std::tuple<std::string, double, double>>);
#undef MARS_VALUE

Option Command::add_flag(const std::string& names, bool& value, const std::string& help) const {
  return Option(*app_->add_flag(names, value, help));
}

Option Command::add_read(const std::string& names, const std::function<void(const std::string& word)>& read,
                         const std::string& help) const {
  const auto take = [names, read](const std::string& word) { as_usage(names, [&] { read(word); }); };
  return Option(*app_->add_option_function<std::string>(names, take, help));
}

Option Command::add_read(const std::string& names, const std::function<void(const std::vector<double>& numbers)>& read,
                         const std::string& help) const {
  return Option(*app_->add_option_function<std::vector<double>>(names, read, help))
      .check(is_empty)
      .check(problem_of_number<double>);
}

Option Command::add_choice(const std::string& name, const std::vector<std::string>& words,
                           const std::function<void(std::size_t number)>& take, const std::string& help) const {
  std::string type;
  for (const std::string& word : words) type += (type.empty() ? "" : "|") + word;
  const auto number_of = [words, take](const std::string& word) {
    take(static_cast<std::size_t>(std::ranges::find(words, word) - words.begin()));
  };
  return Option(*app_->add_option_function<std::string>(name, number_of, help)).one_of(words).type(type);
}

Command Command::footer(const std::string& text) const {
  app_->footer(text);
  return *this;
}

void Command::checks(const std::function<void()>& check) const {
  app_->parse_complete_callback([app = app_, check] {
    if (app->remaining_size() > 0) return;  // unknown words are reported first
    as_usage(app->get_name(), check);
  });
}

void Command::runs(const std::function<void()>& run) const { app_->callback(run); }

std::string Command::name() const { return app_->get_name(); }

Option Command::option(const std::string& name) const { return Option(*app_->get_option(name)); }

std::string Command::first_given(std::initializer_list<std::string_view> names) const {
  for (const Option& each : options())
    if (each.given() && std::ranges::find(names, each.name()) != names.end()) return each.name();
  return "";
}

std::vector<Option> Command::options() const {
  std::vector<Option> all;
  for (CLI::Option* option : app_->get_options())
    if (option != app_->get_help_ptr() && !option->get_group().empty()) all.emplace_back(*option);
  return all;
}

std::vector<Command> Command::commands() const {
  std::vector<Command> all;
  for (CLI::App* command : app_->get_subcommands({})) all.push_back({*command, *kept_});
  return all;
}

}  // namespace mars::cli
