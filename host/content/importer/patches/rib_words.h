// Requests of RIB in text: a name and its arguments.
#pragma once

#include <concepts>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mars::importer {

struct RibArgument {
  std::optional<std::string> text;  // else numbers
  std::vector<double> numbers;
};

struct RibRequest {
  std::string name;
  std::vector<RibArgument> arguments;
  std::size_t line = 1;
};

class RibWords {
 public:
  // `name` is what failures name, with the line.
  RibWords(std::string_view file, std::string name) : rest_(file), name_(std::move(name)) {}
  RibWords(std::same_as<std::string> auto&&, auto&&) = delete;

  // None at the end of the file.
  std::optional<RibRequest> next();

 private:
  void skip();
  std::string_view bare_word();
  RibArgument array();
  std::string text();
  double number();
  [[noreturn]] void refuse(const std::string& problem, const std::string& remedy) const;

  std::string_view rest_;
  std::string name_;
  std::size_t line_ = 1;
};

}  // namespace mars::importer
