// What is open in the studio: one film or model, its file, its history. The same for all pages. Nothing of it knows
// pages, pictures or a network.
//
// A gesture is a change under way: it changes `film()` and no file. Committed, it is a step: written atomically,
// appended to the journal beside the file and put into the history. A film is stored as JSON; every step is a function
// of the libraries that commands use (modeler/edit.h, animator/keys.h, ...), so that both write the same file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "host/content/animator/pose/film.h"
#include "host/content/document/json_file.h"
#include "host/content/modeler/edit_shapes.h"
#include "host/editing/command.h"
#include "host/studio/project/animation.h"

namespace mars::studio {

// A file that cannot be read, or a step that makes no sense. What was open stays open.
struct Problem {
  std::string text;        // problem, where and remedy, in one line
  std::uint32_t line = 0;  // of the file; 0: none
};

class Project {
 public:
  virtual ~Project() = default;

  virtual bool is_model() const = 0;
  // What is shown: the film, with what a gesture has changed; for a model a film of one actor, "model", with light, a
  // camera and a ground to stand on, posed as the page has posed it (a model's file has no pose).
  virtual const animator::Film& film() const = 0;
  // The film's lights are a rig's, no things of their own: none is in the file. So it is with models.
  virtual bool rig_lights() const = 0;
  // Whether keys of the film change this part of the camera or of a light: "fov" of "camera", "reach" of "light/2".
  virtual bool has_keys(const std::string& thing, const std::string& part) const = 0;
  // Goes up when film() changes in any way.
  virtual std::uint64_t revision() const = 0;
  // Goes up when film()'s models have other shapes than those before: nodes need the film again. A gesture that pulls
  // control points does not count; the shape it pulls is `pulled()`.
  virtual std::uint64_t shapes_revision() const = 0;
  struct Pulled {
    std::size_t model, shape;
  };
  virtual std::optional<Pulled> pulled() const = 0;

  // The frame that is shown and at which poses are set.
  virtual std::uint32_t frame() const = 0;
  virtual void set_frame(std::uint32_t frame) = 0;

  // One step of those that docs/studio-protocol.md lists ({"set": "pose", ...}).
  // While the mouse moves: shown, not written. The last one counts; each is complete in itself.
  virtual void preview(const Json& step) = 0;
  // Written. Throws Failure where it makes no sense; film() is then as before the gesture.
  virtual void commit(const Json& step) = 0;
  virtual void cancel() = 0;
  virtual bool in_gesture() const = 0;

  virtual void undo() = 0;  // of all pages' common history; nothing where there is nothing
  virtual void redo() = 0;

  // The control points of a joint's shape ({"set": "point"}) with what a gesture has pulled; none where it has none.
  virtual std::vector<modeler::ControlPoint> control_points(const std::string& /*joint*/) const { return {}; }
  // For the person, about the last step: what was mirrored, clamped. Each once.
  virtual std::vector<std::string> take_remarks() { return {}; }
  // The commands that do what the last step did that was committed, a page's or a hand's. Each once.
  virtual std::vector<editing::Command> take_commands() { return {}; }

  // Looks whether somebody else changed the files: true if something changed here (the film, or the problem).
  virtual bool look_at_files() = 0;
  virtual const std::optional<Problem>& problem() const = 0;

  // All that a page shows of it (docs/studio-protocol.md, "project"), without pictures.
  virtual Json describe() const = 0;
  // What moves during gestures only: the joints' poses, places and turns at the frame ("poses").
  virtual Json describe_poses() const = 0;

  // Goes up when keys of the film may be others; a gesture does not count.
  virtual std::uint64_t keys_revision() const = 0;
  // Its keys, as the file has them, and values over the frames, with what a gesture has changed (animation.h).
  virtual Json channels(const std::vector<std::string>& things) = 0;
  virtual Json curves(const CurvesWanted& wanted) = 0;
  // What a step {"script": ...} would say, or the problem it has ("script"); a gesture ends. And those beside the film.
  virtual Json check_script(const std::string& name, const std::string& text) = 0;
  virtual Json scripts() const = 0;
};

// What a file that is not there is, written with its first step: a model of one joint, or a film with a floor and
// lights.
enum class NewFile { model, film };

// Throws Failure where the file cannot be read at the start, or is no film or model. Steps read and write files below
// `folder` alone; "": the file's own.
std::unique_ptr<Project> open_project(const std::filesystem::path& file, std::filesystem::path folder = {},
                                      NewFile begins = NewFile::model);

}  // namespace mars::studio
