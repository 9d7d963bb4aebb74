// Posing: a figure, the camera, a light or a material, set at a frame by what a person wants of its parts; the limits
// of joints are held. The thesis's quadruple (model, segment, axis, angle) is a setting that is `local`.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "host/content/animator/keys/keys.h"
#include "host/content/animator/keys/part_setting.h"

namespace mars::animator {

// How a pose goes into the keys that there are.
struct PoseManner {
  std::optional<Ease> ease{};  // from there
  Beyond beyond = Beyond::refused;
  // Frames to both sides into which the change of each part is blended, less and less: the keys there change, and what
  // is beyond them stays as it is. 0: the frame alone.
  std::uint32_t falloff = 0;
  // Each setting is a turn of a joint or of a whole actor about its own axis as it stands, one after the other (thesis
  // 3.3); where several keys change, each about its own.
  bool local = false;
};

// Sets the thing `name` (Choice::thing) at the frame. A part without keys also gets one at frame 0, as it was, so that
// it moves from there. Remarks what pops among dense keys where nothing is blended.
Remarks pose(document::Json& film, const Film& meaning, const std::string& name, std::span<const PartSetting> settings,
             std::uint32_t frame, const PoseManner& manner);

// The same as people type the settings. Over several frames settings must be relative: all keys that the parts have
// there change. Throws where a setting finds none.
Remarks pose(document::Json& film, const Film& meaning, const std::string& name, std::span<const std::string> settings,
             FrameRange range, const PoseManner& manner);

// Shows of an actor in `film`, which was read from `json`, what pose() with these settings and no ease would make of
// it, without writing: for every move of a hand. False, and nothing is changed, where the name is no actor's or only
// the file read again says what is wrong.
bool show_pose(Film& film, document::Json& json, const std::string& name, std::span<const std::string> settings,
               std::uint32_t frame, Beyond beyond, Remarks& remarks);

}  // namespace mars::animator
