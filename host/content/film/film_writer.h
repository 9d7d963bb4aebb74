// What a compiled film says of frames, beside the motion of segments: settings, camera, lights, and the segments with
// their names, shapes and materials. Of all frames of a film, or of one (moment.h): both have the same values.
#pragma once

#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

#include "host/content/animator/pose/film.h"
#include "host/content/animator/pose/joint_frames.h"
#include "host/content/film/material_writer.h"
#include "host/content/film/track_writer.h"
#include "node/wire/film.h"

namespace mars::film {

// Of each model, of each of its shapes the number in the compiled film; none of models that no actor has.
using ShapeNumbers = std::vector<std::vector<std::uint32_t>>;

// Adds the shapes of the models that actors have, in the order of the actors.
ShapeNumbers write_shapes(const animator::Film& film, wire::FilmData& data);

// Throws where the camera sees nothing: it looks at its own place, or along its up vector. `joints` are the film's.
wire::Camera camera_at(const animator::Film& film, std::uint32_t frame, animator::JointFrames& joints);

// How many of the first `frames` frames are needed to see all changes of the camera.
std::uint32_t camera_frames(const animator::CameraMotion& motion, std::uint32_t frames);

class FilmWriter {
 public:
  // Both must outlive it.
  FilmWriter(const animator::Film& film, WrittenFrames frames, wire::FilmData& data);
  FilmWriter(const animator::Film&&, auto&&...) = delete;

  void write_settings();  // and camera and lights
  // Without their motion. `data` has the shapes with the numbers `shapes`.
  void write_segments(const ShapeNumbers& shapes);

  // Whether a segment is made of the film's material.
  bool uses(const animator::MaterialMotion& material) const { return materials_.uses(material); }

 private:
  void write_camera();
  void add_bones(wire::Segment& segment, const modeler::Segment& of_model);
  std::uint32_t add_name(const std::string& name);
  std::uint32_t material_name(const std::string& name);

  const animator::Film& film_;
  const WrittenFrames frames_;
  wire::FilmData& data_;
  MaterialWriter materials_;
  std::unordered_map<std::string, std::uint32_t> material_names_;  // where they are
};

}  // namespace mars::film
