// Steps that pages send, each line one: previewed, committed, undone, on a film or a model.
#include "hal/failure/failure.h"
#include "host/studio/project/project.h"
#include "tests/fuzz/scratch.h"
#include "tests/fuzz/studio_pages.h"
#include "tests/fuzz/target.h"

namespace mars::fuzz::studio_steps {
namespace {

void take_step(studio::Project& project, const document::Json& step, std::string& refused) {
  for (const bool commits : {false, true}) try {
      commits ? project.commit(step) : project.preview(step);
    } catch (const Failure& failure) {
      refused = failure.what();
    }
  project.channels({"*"});
  project.curves({"pip", {"place", "head", "attach"}, 0, 9});
  project.describe();
  project.describe_poses();
  project.control_points("head");
}

}  // namespace

void take(std::string_view input) {
  for (const auto& [name, text] : small_film().files) scratch().file(name, text);
  const auto model = scratch().path("pip.json"), film = scratch().path("film.json");
  for (const char* journal : {".pip.json.journal", ".film.json.journal"})
    std::filesystem::remove(scratch().path(journal));
  for (const auto& entry : std::filesystem::directory_iterator(film.parent_path()))
    if (entry.path().extension() == ".script") std::filesystem::remove(entry.path());
  std::string refused;
  for (const auto& path : {film, model}) {
    const auto project = studio::open_project(path);
    project->set_frame(5);
    for (std::size_t at = 0; at < input.size();) {
      const std::size_t end = std::min(input.find('\n', at), input.size());
      const auto step = document::Json::parse(input.substr(at, end - at), nullptr, false);
      if (!step.is_discarded()) take_step(*project, step, refused);
      at = end + 1;
    }
    project->scripts();
    project->check_script("play.script", std::string(input));
    while (project->describe()["undo"].is_string()) project->undo();
  }
  if (!refused.empty()) throw Failure(refused, "", "");
}

const Target target("studio_steps", Form::text, take);

}  // namespace mars::fuzz::studio_steps
