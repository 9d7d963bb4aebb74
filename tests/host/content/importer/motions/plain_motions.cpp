#include "tests/host/content/importer/motions/plain_motions.h"

#include <cmath>
#include <fstream>
#include <functional>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>
#include <numbers>
#include <sstream>

namespace mars::test {
namespace {

glm::dmat4 turn(char axis, double degrees) {
  const double angle = degrees * std::numbers::pi / 180, c = std::cos(angle), s = std::sin(angle);
  const int first = axis == 'X' ? 1 : axis == 'Y' ? 2 : 0, second = (first + 1) % 3;
  glm::dmat4 matrix(1);
  matrix[first][first] = matrix[second][second] = c;
  matrix[first][second] = s;
  matrix[second][first] = -s;
  return matrix;
}

glm::dmat4 moved(const glm::dvec3& by) {
  glm::dmat4 matrix(1);
  matrix[3] = glm::dvec4(by, 1);
  return matrix;
}

struct PlainJoint {
  std::string name;
  glm::dvec3 offset{0};
  std::vector<std::string> channels;
  std::vector<PlainJoint> children;
};

PlainJoint read_joint(std::istream& words) {
  PlainJoint joint;
  std::string word;
  words >> joint.name >> word;
  while (words >> word && word != "}") {
    if (word == "OFFSET") words >> joint.offset.x >> joint.offset.y >> joint.offset.z;
    if (word == "CHANNELS") {
      std::size_t count;
      words >> count;
      joint.channels.resize(count);
      for (std::string& channel : joint.channels) words >> channel;
    }
    if (word == "JOINT") joint.children.push_back(read_joint(words));
    if (word == "End") read_joint(words);
  }
  return joint;
}

// T(offset + positions) R(first) R(second) R(third), as the channels stand in the file.
void place(const PlainJoint& joint, const glm::dmat4& above, std::istream& numbers, Places& places) {
  glm::dvec3 offset = joint.offset;
  glm::dmat4 turns(1);
  for (const std::string& channel : joint.channels) {
    double number;
    numbers >> number;
    if (channel.ends_with("position"))
      offset[channel[0] - 'X'] += number;
    else
      turns = turns * turn(channel[0], number);
  }
  const glm::dmat4 matrix = above * moved(offset) * turns;
  places[joint.name] = glm::dvec3(matrix[3]);
  for (const PlainJoint& child : joint.children) place(child, matrix, numbers, places);
}

struct PlainBone {
  glm::dvec3 direction{0}, axis{0};
  double length = 0;
  std::vector<std::string> dof;
  std::vector<std::string> children;
};

using PlainBones = std::map<std::string, PlainBone>;

PlainBones read_plain_asf(const std::filesystem::path& path) {
  PlainBones bones{{"root", {{}, {}, 0, {"tx", "ty", "tz", "rx", "ry", "rz"}, {}}}};
  std::ifstream file(path);
  std::string line, section, name;
  while (std::getline(file, line)) {
    std::istringstream words(line);
    std::string word;
    if (!(words >> word)) continue;
    if (word[0] == ':') section = word;
    if (section == ":bonedata") {
      if (word == "name") words >> name;
      PlainBone& bone = bones[name];
      if (word == "direction") words >> bone.direction.x >> bone.direction.y >> bone.direction.z;
      if (word == "length") words >> bone.length;
      if (word == "axis") words >> bone.axis.x >> bone.axis.y >> bone.axis.z;
      while (word == "dof" && words >> name) bone.dof.push_back(name);
    } else if (section == ":hierarchy" && bones.contains(word)) {
      while (words >> name) bones[word].children.push_back(name);
    }
  }
  return bones;
}

// L = C M C^-1, C = Rz Ry Rx of the axis, M = Rz Ry Rx of the motion; children stand at the bone's tip.
void place(PlainBones& bones, const std::string& name, const glm::dmat4& above,
           const std::map<std::string, std::map<std::string, double>>& motion, Places& places) {
  PlainBone& bone = bones[name];
  const auto found = motion.find(name);
  const auto number = [&](const std::string& dof) {
    return found != motion.end() && found->second.contains(dof) ? found->second.at(dof) : 0.0;
  };
  const glm::dmat4 c = turn('Z', bone.axis.z) * turn('Y', bone.axis.y) * turn('X', bone.axis.x);
  const glm::dmat4 m = turn('Z', number("rz")) * turn('Y', number("ry")) * turn('X', number("rx"));
  const glm::dmat4 matrix = above * moved({number("tx"), number("ty"), number("tz")}) * c * m * glm::inverse(c);
  places[name] = glm::dvec3(matrix[3]);
  for (const std::string& child : bone.children)
    place(bones, child, matrix * moved(bone.direction * bone.length), motion, places);
}

}  // namespace

std::vector<Places> plain_bvh(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::string word;
  file >> word >> word;
  const PlainJoint root = read_joint(file);
  std::size_t frames;
  double time;
  file >> word >> word >> frames >> word >> word >> time;
  std::vector<Places> all(frames);
  for (Places& places : all) place(root, glm::dmat4(1), file, places);
  return all;
}

std::vector<Places> plain_acclaim(const std::filesystem::path& asf, const std::filesystem::path& amc) {
  PlainBones bones = read_plain_asf(asf);
  std::vector<Places> all;
  std::map<std::string, std::map<std::string, double>> motion;
  const auto end_frame = [&] {
    if (motion.empty()) return;
    all.emplace_back();
    place(bones, "root", glm::dmat4(1), motion, all.back());
    motion.clear();
  };
  std::ifstream file(amc);
  std::string line;
  while (std::getline(file, line)) {
    std::istringstream words(line);
    std::string word;
    if (!(words >> word) || word[0] == '#' || word[0] == ':') continue;
    if (std::isdigit(static_cast<unsigned char>(word[0]))) end_frame();
    if (!bones.contains(word)) continue;
    for (const std::string& dof : bones[word].dof) words >> motion[word][dof];
  }
  end_frame();
  return all;
}

}  // namespace mars::test
