// A model that is open, in a film of its own. Its poses are kept here alone: no file has them.
#pragma once

#include <filesystem>
#include <map>
#include <optional>

#include "host/studio/project/work.h"

namespace mars::studio {

class ModelWork : public Work {
 public:
  // Files that steps name must be below `folder`.
  ModelWork(std::filesystem::path path, std::filesystem::path folder)
      : path_(std::move(path)), folder_(std::move(folder)) {}

  const animator::Film& film() const override { return film_; }
  std::uint64_t shapes_revision() const override { return shapes_revision_; }
  std::optional<Project::Pulled> pulled() const override { return pulled_; }

  void prepare(const std::string& text, bool models_stay) override;
  void accept() override;
  void reject() override { prepared_.reset(); }

  animator::Remarks show(const Step& step, For what) override;
  void take_back() override;
  void keep() override;
  std::string text() const override { return document::laid_out(shown_json()); }
  bool shows() const override { return shows_; }
  std::set<std::size_t> shown_actors() const override { return {0}; }

  std::vector<modeler::ControlPoint> control_points(const std::string& joint) const override;
  void describe(Json& project, std::uint32_t frame) const override;

 private:
  struct Prepared {
    Json json;
    modeler::Model model;
  };

  const modeler::Model& model() const;
  const Json& shown_json() const { return before_ ? shown_json_ : json_; }
  void show_pose(const PoseStep& step);
  animator::Remarks show_commands(const CommandsStep& step);
  void apply_poses(const std::map<std::string, glm::dvec3>& poses);
  void take_shapes(bool pulls);

  std::filesystem::path path_, folder_;
  Json json_, shown_json_;  // the file's; what a gesture makes of it
  animator::Film film_;
  std::optional<modeler::Model> before_;  // the file's, while a gesture shows another
  std::optional<Prepared> prepared_;
  std::map<std::string, glm::dvec3> poses_, shown_poses_;  // kept; of a gesture
  modeler::Model known_;                                   // what nodes have since shapes_revision_ went up
  std::optional<Project::Pulled> pulled_;
  std::uint64_t shapes_revision_ = 0;
  bool shows_ = false;
};

}  // namespace mars::studio
