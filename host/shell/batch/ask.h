// A run of a program of the batch system. Such programs wait for their server, which may never answer: each run has a
// limit.
#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "hal/failure/failure.h"
#include "host/child/process.h"

namespace mars::batch {

constexpr std::chrono::milliseconds kLongestAnswer{30'000};

struct Answer {
  child::Ending ending;
  std::vector<std::string> lines;
  std::string complaints;  // on one line
};

// The program did not answer in time and was ended.
class NoAnswer : public Failure {
 public:
  using Failure::Failure;
};

// `name` stands for the program in messages; the first word is the program, in the PATH or with its folder. Throws
// NoAnswer; child::Stopped where a signal to us ends the program; Failure where the program is not there.
Answer ask(const std::string& name, std::vector<std::string> words, std::chrono::milliseconds longest = kLongestAnswer);

}  // namespace mars::batch
