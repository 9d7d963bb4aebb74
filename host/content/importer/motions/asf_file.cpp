#include "host/content/importer/motions/asf_file.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>

#include "host/content/document/file.h"
#include "host/content/document/text.h"
#include "host/content/importer/motions/motion_words.h"
#include "host/content/modeler/frames.h"

namespace mars::importer {
namespace {

constexpr std::uintmax_t kLargestAcclaim = std::uintmax_t{1} << 30;
constexpr std::size_t kMostBones = 10'000;

struct Bone {
  std::string name;
  glm::dvec3 direction{0}, axis{0};
  double length = 0;
  std::string order = "XYZ";            // of the axis, and of turns: the first is innermost
  std::vector<std::string> dof;         // in small letters
  std::vector<modeler::Limits> limits;  // of the first of `dof`; may be fewer
};

std::string small(std::string_view word) {
  std::string text(word);
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

glm::dmat3 axes_of(const Bone& bone) {
  glm::dmat3 turn(1);
  for (const char letter : bone.order) {
    const int axis = letter - 'X';
    glm::dvec3 about(0);
    about[axis] = 1;
    turn = modeler::rotation_by_degrees(about, bone.axis[axis]) * turn;
  }
  return turn;
}

class AsfReader {
 public:
  AsfReader(std::string_view text, const std::filesystem::path& path) : words_(text, path.string(), "()") {}

  AsfFile read() {
    if (words_.at_end()) words_.fail("is empty", "export the skeleton again");
    root_.name = "root";
    root_.dof = {"tx", "ty", "tz", "rx", "ry", "rz"};
    while (!words_.at_end()) read_section();
    if (bones_.empty()) words_.fail("has no :bonedata", "export the skeleton with its bones");
    if (parents_.empty()) words_.fail("has no :hierarchy", "export the skeleton with its hierarchy");
    add_joints();
    if (lengths_ > 0)
      file_.not_read.push_back(document::counted(lengths_, "bone's change", "bones' changes") + " of length");
    return std::move(file_);
  }

 private:
  void read_section() {
    const std::string word = small(words_.next("a section"));
    if (word == ":units")
      read_units();
    else if (word == ":root")
      read_root();
    else if (word == ":bonedata")
      read_bones();
    else if (word == ":hierarchy")
      read_hierarchy();
    else
      skip_section();
  }

  bool in_section() { return !words_.at_end() && words_.peek().front() != ':'; }

  void skip_section() {
    words_.skip_line();
    while (in_section()) words_.skip_line();
  }

  void read_units() {
    while (in_section()) {
      const std::string word = small(words_.next("a unit"));
      if (word == "angle") {
        const std::string unit = small(words_.next("the unit of angles"));
        if (!unit.starts_with("deg") && !unit.starts_with("rad"))
          words_.fail("has angles in '" + document::printable(unit) + "'", "write deg or rad");
        file_.degrees = unit.starts_with("deg");
      } else {
        words_.skip_line();  // masses; lengths are in one unit anyway
      }
    }
  }

  double angle() { return words_.number("an angle") * (file_.degrees ? 1 : 1 / modeler::kDegree); }

  glm::dvec3 angles() {
    glm::dvec3 read;
    for (int i = 0; i < 3; ++i) read[i] = angle();
    return read;
  }

  glm::dvec3 vector(const char* of) {
    glm::dvec3 read;
    for (int i = 0; i < 3; ++i) read[i] = words_.number(of);
    return read;
  }

  std::string order() {
    std::string word(words_.next("the order of axes"));
    std::ranges::transform(word, word.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    std::string sorted = word;
    std::ranges::sort(sorted);
    if (sorted != "XYZ")
      words_.fail("has the order of axes '" + document::printable(word) + "'",
                  "write X, Y and Z, each once, such as XYZ");
    return word;
  }

  std::vector<std::string> freedoms() {
    std::vector<std::string> all;
    while (!words_.at_line_end()) {
      const std::string word = small(words_.next("a degree of freedom"));
      constexpr std::array<std::string_view, 7> kKnown{"tx", "ty", "tz", "rx", "ry", "rz", "l"};
      if (std::ranges::find(kKnown, word) == kKnown.end())
        words_.fail("has the degree of freedom '" + document::printable(word) + "'",
                    "known are rx, ry, rz, tx, ty, tz, l");
      if (std::ranges::find(all, word) != all.end())
        words_.fail("has the degree of freedom " + word + " twice", "name each once");
      all.push_back(word);
    }
    return all;
  }

  void read_root() {
    while (in_section()) {
      const std::string word = small(words_.next("the root"));
      if (word == "order")
        root_.dof = freedoms();
      else if (word == "axis")
        root_.order = order();
      else if (word == "position")
        root_place_ = vector("the root's position");
      else if (word == "orientation")
        root_.axis = angles();
      else
        words_.fail("has '" + document::printable(word) + "' in :root", "it has order, axis, position, orientation");
    }
  }

  void read_bones() {
    while (in_section()) {
      words_.expect("begin", "before a bone");
      if (bones_.size() == kMostBones) words_.fail("has more than 10000 bones", "export fewer");
      Bone bone;
      while (!words_.takes("end")) read_part(bone);
      if (bone.name.empty()) words_.fail("has a bone without a name", "give each bone a name");
      if (bone.name == root_.name || !bones_.emplace(bone.name, bone).second)
        words_.fail("has two bones '" + document::printable(bone.name) + "'", "give each bone a name of its own");
    }
  }

  void read_part(Bone& bone) {
    const std::string word = small(words_.next("the end of a bone"));
    if (word == "name") {
      bone.name = std::string(words_.next("a bone's name"));
    } else if (word == "direction") {
      bone.direction = vector("a bone's direction");
    } else if (word == "length") {
      bone.length = words_.number("a bone's length");
    } else if (word == "axis") {
      bone.axis = angles();
      bone.order = order();
    } else if (word == "dof") {
      bone.dof = freedoms();
    } else if (word == "limits") {
      while (words_.takes("(")) {
        bone.limits.push_back(limits());
        if (bone.limits.size() > bone.dof.size())
          words_.fail("has more limits in a bone than its " + document::counted(bone.dof.size(), "degree", "degrees") +
                          " of freedom",
                      "give each of the bone's dof its limits, after it");
      }
    } else {
      words_.skip_line();  // id, mass, center of mass
    }
  }

  modeler::Limits limits() {
    modeler::Limits read;
    for (double* bound : {&read.lower, &read.upper}) {
      const std::string word = small(words_.peek());
      if (word == "-inf" || word == "inf")
        words_.next("a limit");  // free
      else
        *bound = angle();
    }
    words_.expect(")", "after two limits");
    if (read.lower > read.upper)
      words_.fail("has the limits " + document::shown(read.lower) + " to " + document::shown(read.upper),
                  "write the lower one first");
    return read;
  }

  void read_hierarchy() {
    words_.expect("begin", "after :hierarchy");
    while (!words_.takes("end")) {
      const std::string parent(words_.next("the end of the hierarchy"));
      require_bone(parent);
      while (!words_.at_line_end()) {
        const std::string child(words_.next("a bone"));
        require_bone(child);
        if (child == root_.name || !parents_.emplace(child, parent).second)
          words_.fail("has a second parent for '" + document::printable(child) + "'", "hang each bone from one other");
        children_[parent].push_back(child);
      }
    }
  }

  void require_bone(const std::string& name) const {
    if (name != root_.name && !bones_.contains(name))
      words_.fail("names '" + document::printable(name) + "', which is no bone of :bonedata", "correct the hierarchy");
  }

  void add_joints() {
    add_joint(root_, modeler::kNone, root_place_);
    std::vector<std::string> names{root_.name};
    for (std::size_t i = 0; i < names.size(); ++i) {
      const Bone& above = i == 0 ? root_ : bones_.at(names[i]);
      for (const std::string& child : children_[names[i]]) {
        add_joint(bones_.at(child), i, tip_of(above));
        names.push_back(child);
      }
      if (const glm::dvec3 tip = tip_of(above); tip != glm::dvec3(0)) file_.skeleton.ends[i].push_back(tip);
    }
    if (names.size() <= bones_.size())
      for (const auto& [name, bone] : bones_)
        if (std::ranges::find(names, name) == names.end())
          words_.fail("has a bone '" + document::printable(name) + "' that hangs from nothing that hangs from the root",
                      "name it in :hierarchy");
  }

  static glm::dvec3 tip_of(const Bone& bone) {
    const double length = glm::length(bone.direction);
    return length > 0 ? bone.direction * (bone.length / length) : glm::dvec3(0);
  }

  // The turns of its axes' order that it is free to make, the last outermost.
  void add_joint(const Bone& bone, std::size_t parent, const glm::dvec3& place) {
    modeler::Joint joint;
    joint.name = bone.name;
    joint.parent = parent;
    joint.place = place;
    const glm::dmat3 axes = axes_of(bone);
    std::vector<glm::dvec3> turns;
    std::map<std::string, std::size_t> parts;
    for (std::size_t i = 3; i-- > 0;) {
      const std::string dof = std::string("r") + small(bone.order.substr(i, 1));
      if (std::ranges::find(bone.dof, dof) == bone.dof.end()) continue;
      parts[dof] = turns.size();
      turns.push_back(axes[bone.order[i] - 'X']);
    }
    const TurnAxes found = turn_axes(turns);
    joint.x_axis = found.x_axis;
    joint.y_axis = found.y_axis;
    for (std::size_t i = turns.size(); i < 3; ++i) joint.limits[i] = {0, 0};
    auto& numbers = file_.numbers.emplace_back();
    for (std::size_t i = 0; i < bone.dof.size(); ++i)
      numbers.push_back(number_of(bone, i, parent, parts, found, joint));
    file_.skeleton.joints.push_back(joint);
    file_.skeleton.ends.emplace_back();
  }

  // What the number `index` of a bone's line is; sets its limits.
  AcclaimNumber number_of(const Bone& bone, std::size_t index, std::size_t parent,
                          const std::map<std::string, std::size_t>& parts, const TurnAxes& axes,
                          modeler::Joint& joint) {
    const std::string& dof = bone.dof[index];
    if (const auto part = parts.find(dof); part != parts.end()) {
      const double sign = part->second == 2 ? axes.third : 1;
      if (index < bone.limits.size()) {
        const modeler::Limits& limits = bone.limits[index];
        joint.limits[part->second] = sign > 0 ? limits : modeler::Limits{-limits.upper, -limits.lower};
      }
      return {true, false, static_cast<int>(part->second), sign};
    }
    if (parent == modeler::kNone && dof[0] == 't') return {false, true, dof[1] - 'x', 1};
    ++lengths_;
    return {};
  }

  MotionWords words_;
  AsfFile file_;
  Bone root_;
  glm::dvec3 root_place_{0};
  std::map<std::string, Bone> bones_;
  std::map<std::string, std::string> parents_;
  std::map<std::string, std::vector<std::string>> children_;
  std::size_t lengths_ = 0;
};

class AmcReader {
 public:
  AmcReader(std::string_view text, const std::filesystem::path& path, const AsfFile& skeleton)
      : words_(text, path.string(), ""), skeleton_(skeleton), degrees_(skeleton.degrees) {
    for (std::size_t i = 0; i < skeleton.skeleton.joints.size(); ++i) joints_[skeleton.skeleton.joints[i].name] = i;
  }

  Motion read(double rate) {
    motion_.rate = rate;
    read_head();
    while (!words_.at_end()) read_frame();
    if (motion_.poses.empty()) words_.fail("has no frames", "export the motion again");
    return std::move(motion_);
  }

 private:
  void read_head() {
    for (; !words_.at_end(); words_.skip_line()) {
      const std::string_view word = words_.peek();
      if (same_word(word, ":DEGREES")) degrees_ = true;
      if (same_word(word, ":RADIANS")) degrees_ = false;
      if (word.front() != '#' && word.front() != ':') return;
    }
  }

  void read_frame() {
    words_.whole_number("a frame's number");
    const bool first = motion_.poses.empty();
    if (first)
      motion_.poses.emplace_back(joints_.size(), glm::dvec3(0));
    else
      motion_.poses.push_back(std::vector(motion_.poses.back()));
    motion_.places.push_back(first ? skeleton_.skeleton.joints[0].place : glm::dvec3(motion_.places.back()));
    while (!words_.at_end() && !document::number_in<double>(words_.peek())) read_bone();
    if (first) require_all();
  }

  void read_bone() {
    const std::string name(words_.next("a bone"));
    const auto joint = joints_.find(name);
    if (joint == joints_.end())
      words_.fail("names '" + document::printable(name) + "', which is no bone of the skeleton",
                  "give the ASF file of this motion with --skeleton");
    if (motion_.poses.size() == 1) named_.push_back(joint->second);
    const std::vector<AcclaimNumber>& numbers = skeleton_.numbers[joint->second];
    for (const AcclaimNumber& number : numbers) {
      if (words_.at_line_end()) refuse_count(name, numbers.size());
      const double value = words_.number("a degree of freedom");
      if (number.turns)
        motion_.poses.back()[joint->second][number.part] = number.sign * value * (degrees_ ? 1 : 1 / modeler::kDegree);
      if (number.moves) motion_.places.back()[number.part] = skeleton_.skeleton.joints[0].place[number.part] + value;
    }
    if (!words_.at_line_end()) refuse_count(name, numbers.size());
  }

  [[noreturn]] void refuse_count(const std::string& name, std::size_t count) const {
    words_.fail("has not the " + document::counted(count, "number") + " for '" + document::printable(name) +
                    "' that its dof in the ASF file has",
                "give the ASF file of this motion with --skeleton");
  }

  // The first frame must say of each bone that moves where it is.
  void require_all() const {
    for (std::size_t i = 0; i < skeleton_.numbers.size(); ++i)
      if (!skeleton_.numbers[i].empty() && std::ranges::find(named_, i) == named_.end())
        words_.fail("leaves '" + document::printable(skeleton_.skeleton.joints[i].name) + "' out of its first frame",
                    "give the ASF file of this motion with --skeleton");
  }

  MotionWords words_;
  const AsfFile& skeleton_;
  bool degrees_;
  Motion motion_;
  std::map<std::string, std::size_t> joints_;
  std::vector<std::size_t> named_;  // in the first frame
};

}  // namespace

AsfFile read_asf(const std::filesystem::path& path) {
  const std::string text = document::read_file(path, kLargestAcclaim);
  return AsfReader(text, path).read();
}

Motion read_amc(const std::filesystem::path& path, const AsfFile& skeleton, double rate) {
  const std::string text = document::read_file(path, kLargestAcclaim);
  return AmcReader(text, path, skeleton).read(rate);
}

}  // namespace mars::importer
