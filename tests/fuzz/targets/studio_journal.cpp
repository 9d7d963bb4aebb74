// Journals beside a file: whatever one holds, all of its history can be undone and redone.
#include "host/studio/project/project.h"
#include "tests/fuzz/scratch.h"
#include "tests/fuzz/target.h"

namespace mars::fuzz::studio_journal {

void take(std::string_view input) {
  const auto model = scratch().file("a.json", R"({"joints": [{"name": "a"}, {"name": "b", "parent": "a"}]})");
  scratch().file(".a.json.journal", input);
  const auto project = studio::open_project(model);
  constexpr int kMost = 20;
  for (int i = 0; i < kMost && project->describe()["undo"].is_string(); ++i) project->undo();
  for (int i = 0; i < kMost && project->describe()["redo"].is_string(); ++i) project->redo();
  project->commit({{"commands", {{"model", "set", "b", "--place", "1", "2", "3"}}}});
}

const Target target("studio_journal", Form::text, take);

}  // namespace mars::fuzz::studio_journal
