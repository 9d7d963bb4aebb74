#include "host/shell/batch/ask.h"

#include "host/child/child.h"
#include "host/child/environment.h"
#include "host/child/programs.h"
#include "host/content/document/text.h"

namespace mars::batch {

Answer ask(const std::string& name, std::vector<std::string> words, std::chrono::milliseconds longest) {
  const auto found = child::find_program(words.front(), child::program_path(child::own_environment()));
  if (!found) throw Failure(words.front() + " was not found", "", "use a machine from which jobs are submitted");
  words.front() = found->string();
  Answer answer;
  child::Child child(child::Command{{}, words});
  const auto [ending, late] = child::wait_at_most(
      child, longest, [&](const std::string& line) { answer.lines.push_back(line); },
      [&](const std::string& line) { answer.complaints += (answer.complaints.empty() ? "" : "; ") + line; });
  answer.ending = ending;
  // An answer counts though a process that the program has left behind held the output open.
  if (late && (!answer.ending.well() || answer.lines.empty()))
    throw NoAnswer(
        name + " has not answered for " + document::shown(std::chrono::duration<double>(longest).count()) + " seconds",
        "", "see with its own programs whether the batch system works and what it has queued; then try again");
  return answer;
}

}  // namespace mars::batch
