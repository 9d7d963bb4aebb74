#include "host/content/importer/motions/bvh_file.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <numeric>

#include "hal/failure/failure.h"
#include "host/content/document/file.h"
#include "host/content/document/text.h"
#include "host/content/importer/motions/motion_words.h"

namespace mars::importer {
namespace {

constexpr std::uintmax_t kLargestBvh = std::uintmax_t{1} << 30;
constexpr std::size_t kMostBvhJoints = 10'000, kMostChannels = 6;
constexpr double kNearOffset = 0.25;  // of the offset's length: positions so near to it stand in its stead
constexpr double kStill = 1e-5;       // of the skeleton's size: a joint that slides less keeps its place

struct Channel {
  bool turns;
  int axis;
};

struct BvhJoint {
  std::vector<Channel> channels;
  glm::dvec3 offset{0};
  std::size_t first = 0;  // of a frame's numbers
  double third = 1;

  // 1 along the axes for which it has channels of positions, else 0.
  glm::dvec3 placed_axes() const {
    glm::dvec3 axes(0);
    for (const Channel& channel : channels)
      if (!channel.turns) axes[channel.axis] = 1;
    return axes;
  }
};

glm::dvec3 unit(int axis) {
  glm::dvec3 vector(0);
  vector[axis] = 1;
  return vector;
}

class BvhReader {
 public:
  BvhReader(std::string_view text, const std::filesystem::path& path) : words_(text, path.string(), "{}") {}

  BvhFile read() {
    words_.expect("HIERARCHY", "at its beginning");
    words_.expect("ROOT", "after HIERARCHY");
    read_joints();
    if (same_word(words_.peek(), "ROOT"))
      words_.fail("has a second ROOT, and a figure has one",
                  "keep one ROOT in the file, and import the others from files of their own");
    words_.expect("MOTION", "after the joints");
    read_frames();
    take_places();
    return std::move(file_);
  }

 private:
  // From behind ROOT to the brace that ends it.
  void read_joints() {
    std::vector<std::size_t> open{begin_joint(modeler::kNone)};
    while (!open.empty()) {
      const std::size_t joint = open.back();
      if (words_.takes("}"))
        open.pop_back();
      else if (words_.takes("JOINT"))
        open.push_back(begin_joint(joint));
      else if (words_.takes("End"))
        read_end(joint);
      else if (words_.takes("OFFSET"))
        file_.skeleton.joints[joint].place = joints_[joint].offset = vector("an offset");
      else if (words_.takes("CHANNELS"))
        read_channels(joint);
      else
        words_.fail("has '" + document::printable(words_.next("the end of a joint")) + "' in a joint",
                    "a joint has OFFSET, CHANNELS, JOINT, End Site");
    }
  }

  std::size_t begin_joint(std::size_t parent) {
    std::string_view name = words_.rest_of_line();
    const bool opened = name.ends_with('{');
    if (opened) name.remove_suffix(1);
    while (!name.empty() && (name.back() == ' ' || name.back() == '\t')) name.remove_suffix(1);
    if (joints_.size() == kMostBvhJoints) words_.fail("has more than 10000 joints", "export fewer");
    modeler::Joint joint;
    joint.name = std::string(name);
    joint.parent = parent;
    file_.skeleton.joints.push_back(joint);
    file_.skeleton.ends.emplace_back();
    joints_.emplace_back();
    if (!opened) words_.expect("{", "after a joint's name");
    return joints_.size() - 1;
  }

  void read_end(std::size_t joint) {
    words_.expect("Site", "after End");
    words_.expect("{", "after End Site");
    if (words_.takes("OFFSET")) file_.skeleton.ends[joint].push_back(vector("an end site's offset"));
    words_.expect("}", "after an end site");
  }

  glm::dvec3 vector(const char* of) {
    glm::dvec3 read;
    for (int axis = 0; axis < 3; ++axis) read[axis] = words_.number(of);
    return read;
  }

  void read_channels(std::size_t number) {
    BvhJoint& joint = joints_[number];
    if (!joint.channels.empty()) words_.fail("has a second list of channels in a joint", "give each joint one");
    const std::size_t count = words_.whole_number("the number of channels");
    if (count > kMostChannels)
      words_.fail("has " + std::to_string(count) + " channels in a joint", "a joint has at most 6");
    joint.first = channels_;
    for (std::size_t i = 0; i < count; ++i) joint.channels.push_back(channel());
    channels_ += count;
    set_axes(file_.skeleton.joints[number], joint);
  }

  Channel channel() {
    const std::string_view word = words_.next("a channel");
    for (int axis = 0; axis < 3; ++axis) {
      const std::string letter(1, "XYZ"[axis]);
      if (same_word(word, letter + "rotation")) return {true, axis};
      if (same_word(word, letter + "position")) return {false, axis};
    }
    words_.fail("has a channel '" + document::printable(word) + "'",
                "channels are Xposition, Yposition, Zposition, Xrotation, Yrotation, Zrotation");
  }

  void set_axes(modeler::Joint& joint, BvhJoint& bvh) {
    std::vector<glm::dvec3> axes;
    for (const Channel& channel : bvh.channels)
      if (channel.turns) axes.push_back(unit(channel.axis));
    if (axes.size() > 3 || !distinct(axes))
      words_.fail("has a joint that turns about one axis twice", "export rotations about x, y and z, each once");
    const TurnAxes found = turn_axes(axes);
    joint.x_axis = found.x_axis;
    joint.y_axis = found.y_axis;
    bvh.third = found.third;
    for (std::size_t axis = axes.size(); axis < 3; ++axis) joint.limits[axis] = {0, 0};
  }

  void read_frames() {
    if (!words_.takes("Frames:")) {
      words_.expect("Frames", "after MOTION");
      words_.expect(":", "after Frames");
    }
    const std::size_t count = words_.whole_number("the number of frames");
    words_.expect("Frame", "after the number of frames");
    if (!words_.takes("Time:")) {
      words_.expect("Time", "after Frame");
      words_.expect(":", "after Frame Time");
    }
    const double time = words_.number("the frame time");
    if (!(time >= 0.001 && time <= 1000))
      words_.fail("has a frame time of " + document::shown(time) + " s", "it is from 0.001 to 1000 seconds");
    file_.motion.rate = 1 / time;
    if (channels_ == 0 && count > 0) words_.fail("has frames, but no channels", "export its joints with rotations");
    for (std::size_t frame = 0; frame < count; ++frame) read_frame(frame, count);
    if (!words_.at_end())
      words_.fail("goes on after its last frame, " + std::to_string(count),
                  "correct the number after Frames:, or the number of numbers in its lines");
  }

  void read_frame(std::size_t frame, std::size_t count) {
    if (words_.at_end())
      words_.fail("promises " + std::to_string(count) + " frames and ends after " + std::to_string(frame),
                  "the file may be cut short: export it again");
    std::vector<double> numbers(channels_);
    for (double& number : numbers) number = words_.number("a channel of a frame");
    auto& poses = file_.motion.poses.emplace_back(joints_.size(), glm::dvec3(0));
    for (std::size_t i = 0; i < joints_.size(); ++i) {
      int turn = 0;
      glm::dvec3 place = joints_[i].offset;
      for (std::size_t c = 0; c < joints_[i].channels.size(); ++c) {
        const Channel& channel = joints_[i].channels[c];
        const double number = numbers[joints_[i].first + c];
        if (channel.turns)
          poses[i][turn] = turn == 2 ? joints_[i].third * number : number, ++turn;
        else
          place[channel.axis] = number;
      }
      if (joints_[i].placed_axes() != glm::dvec3(0)) places_[i].push_back(place);
    }
  }

  // Of joints with channels of positions. The root's become the motion's; other joints of a model cannot slide, so the
  // mean of theirs is where they are.
  void take_places() {
    const SkeletonBox box = rest_box(file_.skeleton);
    const double size = glm::length(box.max - box.min);
    const std::size_t frames = file_.motion.poses.size();
    file_.motion.places.assign(frames, joints_[0].offset);
    std::size_t sliding = 0;
    double farthest = 0;
    for (const auto& [number, places] : places_) {
      const glm::dvec3& offset = joints_[number].offset;
      const bool instead = stand_instead(offset, places);
      const glm::dvec3 added = instead ? glm::dvec3(0) : offset * joints_[number].placed_axes();
      if (number == 0) {
        for (std::size_t frame = 0; frame < frames; ++frame) file_.motion.places[frame] = places[frame] + added;
        if (offset != glm::dvec3(0))
          file_.remarks.push_back(instead ? "the root's positions, which stand in its OFFSET's stead"
                                          : "the root's positions, added to its OFFSET");
        continue;
      }
      const glm::dvec3 mean = std::accumulate(places.begin(), places.end(), glm::dvec3(0)) / double(places.size());
      double slides = 0;
      for (const glm::dvec3& place : places) slides = std::max(slides, glm::length(place - mean));
      file_.skeleton.joints[number].place = mean + added;
      sliding += slides > kStill * size;
      farthest = std::max(farthest, slides);
    }
    if (sliding > 0)
      file_.not_read.push_back("how " + document::counted(sliding, "joint slides", "joints slide") + ", up to " +
                               document::formatted("%.3g", farthest) +
                               " units of the file: joints keep their mean places");
  }

  static bool stand_instead(const glm::dvec3& offset, const std::vector<glm::dvec3>& places) {
    return glm::length(places.front() - offset) <= kNearOffset * glm::length(offset);
  }

  MotionWords words_;
  BvhFile file_;
  std::vector<BvhJoint> joints_;
  std::size_t channels_ = 0;
  std::map<std::size_t, std::vector<glm::dvec3>> places_;  // by joint and frame
};

}  // namespace

BvhFile read_bvh(const std::filesystem::path& path) {
  const std::string text = document::read_file(path, kLargestBvh);
  return BvhReader(text, path).read();
}

}  // namespace mars::importer
