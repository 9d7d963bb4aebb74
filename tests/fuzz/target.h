// A fuzz target: a program that takes any input at all. What is wrong with an input must come out as a Failure whose
// message can be shown; whatever else is thrown, a crash, an endless loop or a sanitizer's finding is a bug of ours.
// Each target is one file that says what this header declares. libfuzzer.cpp and plain_driver.cpp give it inputs.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace mars::fuzz {

// What inputs are: text, which is changed by words and lines; or bytes, among them scripts of edits (edits.h).
enum class Form { text, bytes };

// Each target's own.
extern const Form kForm;
void take(std::string_view input);

struct Counts {
  std::uint64_t taken = 0;
  std::uint64_t refused = 0;  // by a Failure
};

// Gives an input to the target; returns why it was refused, "" where it was taken. Ends the process with a word where
// that is a finding.
std::string run(std::string_view input);
const Counts& counts();

}  // namespace mars::fuzz
