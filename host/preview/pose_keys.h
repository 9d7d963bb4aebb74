// Keys that pose a figure: select a joint, turn it, set a key of the film file.
#pragma once

#include <optional>
#include <string>

#include "host/preview/joint_order.h"
#include "host/preview/key_file.h"
#include "host/preview/key_press.h"
#include "host/preview/load.h"

namespace mars::preview {

// Whether the key is for posing.
bool is_pose_key(const KeyPress& key);

// Of what is loaded from `path`, which is `film` until change_film().
class PoseKeys {
 public:
  PoseKeys(Previewed& film, std::filesystem::path path);

  // The selection stays, and a pose that is no key yet.
  void change_film(Previewed& film);

  // False: it is no key for posing.
  bool handle_key(const KeyPress& key, std::uint32_t frame);
  // Whether there are angles that are no keys yet.
  bool under_way() const { return pose_.angles() != written_; }

  // What is to be seen: of a pose that has become keys too, until the film has them.
  const PoseUnderWay& pose() const { return pose_; }
  Posed posed_at(std::uint32_t frame) const;

  // The selected joint with its angles and limits, and what the last key did; "": nothing is selected or there is
  // nothing to report.
  std::string note(std::uint32_t frame) const;
  static std::string keys();

 private:
  std::string done_by(const KeyPress& key, std::uint32_t frame);
  std::string turn(int axis, double degrees, std::uint32_t frame);
  std::string turn_own(int axis, double degrees, std::uint32_t frame);
  std::string rest(std::uint32_t frame);
  std::string set_key(std::uint32_t frame);
  std::string undo();
  std::string give_up();
  const modeler::Joint& joint() const;

  Previewed* film_;
  KeyFile file_;
  std::optional<JointOrder> order_;
  std::optional<JointNumber> selected_;
  PoseUnderWay pose_;
  PoseUnderWay::ByNames written_;  // became keys, which the film is still to be loaded with
  bool fine_ = false;              // steps
  bool own_axes_ = false;          // turns are about the joint's axes as they stand, not by its numbers
  std::string said_;               // about the last key
};

}  // namespace mars::preview
