// A fuzz target takes any input at all. What is wrong with an input must come out as a Failure whose message can be
// shown; whatever else is thrown, a crash, an endless loop or a sanitizer's finding is a bug of ours. Each target is
// one file of targets/ and a namespace of the same name, where it says `const Target target("ply", Form::text, take);`.
// libfuzzer.cpp and plain_driver.cpp give targets inputs.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace mars::fuzz {

// What inputs are: text, which is changed by words and lines; or bytes, among them scripts of edits (edits.h).
enum class Form { text, bytes };

// Lives as long as the program, whose list of targets it joins.
struct Target {
  Target(std::string name, Form form, void (*take)(std::string_view input));
  Target(const Target&) = delete;
  Target& operator=(const Target&) = delete;

  const std::string name;
  const Form form;
  void (*const take)(std::string_view input);
};

// The program's targets by name.
std::vector<const Target*> all_targets();

struct Counts {
  std::uint64_t taken = 0;
  std::uint64_t refused = 0;  // by a Failure
};

// Gives an input to the target; returns why it was refused, "" where it was taken. Ends the process with a word where
// that is a finding.
std::string run(const Target& target, std::string_view input);
const Counts& counts();

}  // namespace mars::fuzz
