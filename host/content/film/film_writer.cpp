#include "host/content/film/film_writer.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "hal/failure/failure.h"
#include "host/content/animator/pose/camera_points.h"
#include "host/content/elementary/elementary.h"
#include "host/content/film/light_writer.h"
#include "host/content/film/shape_writer.h"

namespace mars::film {
namespace {

constexpr std::uint64_t kMost = std::numeric_limits<std::uint32_t>::max();

[[noreturn]] void fail(const animator::Film& film, const std::string& what, const std::string& element,
                       const std::string& remedy) {
  throw Failure(what, film.source.empty() ? element : film.source + ": " + element, remedy);
}

// Between keys a number may swing beyond what keys may give.
double within(const document::Range& range, double number) { return std::clamp(number, range.lowest, range.highest); }

// Of wire::Camera.
double focal_at(const animator::CameraMotion& motion, std::uint32_t frame) {
  if (motion.projection == wire::Projection::panorama) return 1;
  if (motion.projection == wire::Projection::orthographic)
    return 2 / within(keys::range_of("camera", "height"), animator::value_at(motion.height, frame));
  const double half =
      within(keys::range_of("camera", "fov"), animator::value_at(motion.fov, frame)) * (std::numbers::pi / 360);
  return elementary::cos(half) / elementary::sin(half);
}

}  // namespace

ShapeNumbers write_shapes(const animator::Film& film, wire::FilmData& data) {
  ShapeNumbers numbers(film.models.size());
  ShapeWriter writer(data);
  for (const animator::Actor& actor : film.actors) {
    auto& own = numbers[actor.model];
    if (own.empty())
      for (const modeler::Shape& shape : film.models[actor.model].shapes) own.push_back(writer.add(shape));
  }
  return numbers;
}

wire::Camera camera_at(const animator::Film& film, std::uint32_t frame, animator::JointFrames& joints) {
  const animator::CameraMotion& motion = film.camera;
  const glm::dvec3 eye = animator::place_at(motion.eye, frame, joints);
  const glm::dvec3 ahead = animator::place_at(motion.at, frame, joints) - eye;
  const double distance = glm::length(ahead);
  const glm::dvec3 up = animator::value_at(motion.up, frame);
  const double length = glm::length(up);
  const auto refuse = [&](const char* what, const char* remedy) {
    fail(film, what, "camera, frame " + std::to_string(frame), remedy);
  };
  if (distance < 1e-9) refuse("has its eye where it looks at", "move eye or at");
  const glm::dvec3 forward = ahead / distance;
  const glm::dvec3 right = glm::cross(forward, up) / length;
  if (length < 1e-9 || glm::length(right) < 1e-6) refuse("looks along its up vector", "choose another up");
  const glm::dvec3 x = glm::normalize(right), axes[3] = {x, glm::cross(x, forward), -forward};
  wire::Camera camera;
  for (int row = 0; row < 3; ++row)
    camera.world_to_eye.m[row] = {axes[row].x, axes[row].y, axes[row].z, -glm::dot(axes[row], eye)};
  camera.projection = motion.projection;
  camera.focal = focal_at(motion, frame);
  const bool panorama = motion.projection == wire::Projection::panorama;
  const glm::dvec2 shift = panorama ? glm::dvec2(0) : animator::value_at(motion.shift, frame);
  camera.shift_x = within({-wire::kMostShift, wire::kMostShift}, shift.x);
  camera.shift_y = within({-wire::kMostShift, wire::kMostShift}, shift.y);
  camera.near = motion.near;
  camera.far = motion.far;
  camera.exposure =
      elementary::exp2(within(keys::range_of("camera", "exposure"), animator::value_at(motion.exposure, frame)));
  return camera;
}

std::uint32_t camera_frames(const animator::CameraMotion& motion, std::uint32_t frames) {
  if (animator::follows(motion.eye) || animator::follows(motion.at)) return frames;
  return frames_to_see(frames, motion.eye, motion.at, motion.up, motion.fov, motion.height, motion.shift,
                       motion.exposure);
}

FilmWriter::FilmWriter(const animator::Film& film, WrittenFrames frames, wire::FilmData& data)
    : film_(film), frames_(frames), data_(data), materials_(film, frames, data) {}

void FilmWriter::write_settings() {
  wire::FilmSettings& settings = data_.settings;
  settings.width = film_.width;
  settings.height = film_.height;
  settings.pixel_aspect = float(film_.pixel_aspect);
  settings.frames = frames_.count;
  settings.dice = film_.dice;
  settings.rate = float(film_.rate);
  write_light_settings(film_, settings);
  write_camera();
  write_lights(film_, frames_, data_);
}

void FilmWriter::write_camera() {
  TrackWriter<wire::Camera> track(data_.cameras);
  animator::JointFrames joints(film_);
  const std::uint32_t frames = camera_frames(film_.camera, frames_.count);
  for (std::uint32_t frame = 0; frame < frames; ++frame)
    track.add(frame, camera_at(film_, frames_.first + frame, joints));
  data_.settings.camera = track.write(data_.changes);
}

void FilmWriter::write_segments(const ShapeNumbers& shapes) {
  std::uint64_t instances = 0, joints = 0;  // patches and meshlets of all segments
  for (const animator::Actor& actor : film_.actors) {
    const modeler::Model& model = film_.models[actor.model];
    for (const modeler::Joint& joint : model.joints) {
      if (!joint.segment) continue;
      data_.segments.push_back({shapes[actor.model][joint.segment->shape],
                                add_name(actor.name + "/" + joint.name),
                                {},
                                materials_.track_of(actor, joint.segment->material),
                                material_name(materials_.name_of(actor, joint.segment->material))});
      if (!joint.segment->bones.empty()) add_bones(data_.segments.back(), *joint.segment);
      const std::uint32_t shape = data_.segments.back().shape;
      if (shape < data_.shapes.size()) instances += data_.shapes[shape].size();
    }
    joints += model.joints.size();
    if (instances > kMost || joints > kMost)
      fail(film_, "have more than 4294967295 patches and pieces of meshes", "actors", "use fewer actors");
  }
}

void FilmWriter::add_bones(wire::Segment& segment, const modeler::Segment& of_model) {
  segment.first_bone = static_cast<std::uint32_t>(data_.bones.size());
  segment.bone_count = static_cast<std::uint32_t>(of_model.bones.size());
  segment.blend = of_model.blend;
  data_.bones.resize(data_.bones.size() + of_model.bones.size());
}

// Each once.
std::uint32_t FilmWriter::material_name(const std::string& name) {
  const auto known = material_names_.find(name);
  return known != material_names_.end() ? known->second : material_names_.emplace(name, add_name(name)).first->second;
}

std::uint32_t FilmWriter::add_name(const std::string& name) {
  if (data_.names.size() + name.size() + 1 > kMost)
    fail(film_, "have names of more than 4 GB", "actors", "shorten them");
  const auto offset = static_cast<std::uint32_t>(data_.names.size());
  data_.names.insert(data_.names.end(), name.c_str(), name.c_str() + name.size() + 1);
  return offset;
}

}  // namespace mars::film
