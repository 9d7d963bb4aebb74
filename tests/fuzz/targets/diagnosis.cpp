// What a job that failed left: the first line is its fault event, the others are its last words on standard error.
#include "hal/failure/failure.h"
#include "host/shell/launch/diagnosis.h"
#include "host/shell/launch/text_reader.h"
#include "tests/fuzz/target.h"

namespace mars::fuzz::diagnosis {

void take(std::string_view input) {
  launch::Remains remains;
  remains.program = "mpirun";
  remains.ending.code = 1;
  while (!input.empty()) {
    const std::size_t end = std::min(input.find('\n'), input.size());
    const std::string_view line = input.substr(0, end);
    const auto event = events::read_event(line);
    if (event && std::holds_alternative<events::Fault>(*event)) remains.fault = std::get<events::Fault>(*event);
    if (event && std::holds_alternative<events::Booted>(*event)) remains.booted = std::get<events::Booted>(*event);
    remains.last_words.emplace_back(line);
    input.remove_prefix(std::min(end + 1, input.size()));
  }
  const options::RenderOptions options;
  remains.passed_on = remains.last_words.size() % 3 == 0 ? 15 : 0;
  launch::stopped(remains, options);
  launch::diagnose(remains, options, [] { return "look at it"; });
}

const Target target("diagnosis", Form::text, take);

}  // namespace mars::fuzz::diagnosis
