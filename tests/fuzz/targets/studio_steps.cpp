// Steps that pages send, each line one: previewed, committed, undone, on a film or a model.
#include "hal/failure/failure.h"
#include "host/studio/project/project.h"
#include "tests/fuzz/scratch.h"
#include "tests/fuzz/target.h"

namespace mars::fuzz {
namespace {

constexpr const char* kModel = R"({"limbs": {"left": {"hip": "left-leg"}}, "joints": [
  {"name": "hip", "place": [0, 0, 1], "segment": {"shape": "box", "material": "shirt"}},
  {"name": "head", "parent": "hip", "place": [0, 0, 1], "segment": {"shape": "cloth"}},
  {"name": "left-leg", "parent": "hip", "place": [0, 0.5, 0], "limits": {"x": [-10, 30]}, "segment": {"shape": "cone"}}],
  "shapes": {"cloth": {"bspline": {"points": [[[0, 0, 0], [1, 0, 0]], [[0, 0, 1], [1, 0, 1]]],
                                   "u": {"degree": 1}, "v": {"degree": 1}}}},
  "materials": {"shirt": {"color": [1, 0, 0]}}})";
constexpr const char* kFilm = R"({"frames": 9, "camera": {"eye": [9, 0, 2], "at": [0, 0, 1]},
  "models": {"pip": "pip.json"}, "actors": [{"name": "pip", "model": "pip", "keys": [{"frame": 4, "place": [1, 0, 0]}]}]})";

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

const Form kForm = Form::text;

void take(std::string_view input) {
  const auto model = scratch().file("pip.json", kModel), film = scratch().file("film.json", kFilm);
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

}  // namespace mars::fuzz
