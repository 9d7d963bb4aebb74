// What a project makes of its file's text, in memory: a film, or a model in a film of its own. No file is read here but
// those that the text names, none written.
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "host/content/animator/pose/film.h"
#include "host/content/animator/pose/within_limits.h"
#include "host/studio/project/project.h"
#include "host/studio/project/step.h"

namespace mars::studio {

class Work {
 public:
  virtual ~Work() = default;

  virtual const animator::Film& film() const = 0;
  virtual std::uint64_t shapes_revision() const = 0;
  virtual std::optional<Project::Pulled> pulled() const { return std::nullopt; }

  // Another text of the file, in three steps: what it means, kept aside; then that is what is open, or it is dropped.
  // prepare() throws Failure where the text is no film or model. `models_stay`: no other file has changed.
  virtual void prepare(const std::string& text, bool models_stay) = 0;
  virtual void accept() = 0;
  virtual void reject() = 0;

  // Changes film() by the step; what an earlier one showed is taken back first. Throws Failure where it makes no sense:
  // nothing is shown then. A hand's moves are for eyes alone: they cannot be kept.
  enum class For { eyes, file };
  virtual animator::Remarks show(const Step& step, For what) = 0;
  virtual void take_back() = 0;
  virtual void keep() = 0;  // what is shown is what is open
  virtual bool shows() const = 0;
  virtual std::string text() const = 0;                    // of a file with what is shown
  virtual std::set<std::size_t> shown_actors() const = 0;  // that move while it shows

  // As Project's; a model has no keys.
  virtual Json channels(const std::vector<std::string>& /*things*/) {
    return {{"is", "channels"}, {"things", Json::array()}};
  }
  virtual Json curves(const CurvesWanted& wanted) {
    return {{"is", "curves"}, {"thing", wanted.thing}, {"first", wanted.first}, {"parts", Json::array()}};
  }

  virtual std::vector<modeler::ControlPoint> control_points(const std::string& /*joint*/) const { return {}; }
  // Its lights are no things of the film.
  virtual bool rig_lights() const { return true; }
  virtual bool has_keys(const std::string& /*thing*/, const std::string& /*part*/) const { return false; }
  // Into the description: actors, materials, shapes.
  virtual void describe(Json& project, std::uint32_t frame) const = 0;
  // Into what is said during gestures: camera and lights where it changes them.
  virtual void describe_shown(Json& /*poses*/, std::uint32_t /*frame*/) const {}
};

}  // namespace mars::studio
