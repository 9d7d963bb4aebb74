// All that a machine may say to the doctor that asks it: lines, each taken as an answer and as a list of doors.
#include <sstream>

#include "host/shell/doctor/answers.h"
#include "tests/fuzz/target.h"

namespace mars::fuzz::doctor_answers {

void take(std::string_view input) {
  doctor::Answers answers;
  std::string words;
  std::istringstream lines{std::string(input)};
  for (std::string line; std::getline(lines, line);) {
    doctor::read_doors(line);
    if (!answers.take(line, {})) words += line + "\n";
  }
  doctor::text_of(doctor::check_together(answers));
  doctor::text_of(doctor::grouped(answers.findings));
  doctor::check_silence({"n1"}, words, "mars");
}

const Target target("doctor_answers", Form::text, take);

}  // namespace mars::fuzz::doctor_answers
