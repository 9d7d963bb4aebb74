#include "host/content/importer/scene_motion.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <span>
#include <string_view>

#include "hal/failure/failure.h"
#include "host/content/elementary/elementary.h"
#include "host/content/importer/assimp_matrix.h"
#include "host/content/importer/loaded_scene.h"
#include "host/content/importer/scene_nodes.h"
#include "host/content/modeler/joint.h"

namespace mars::importer {
namespace {

constexpr double kUsualTicks = 25;  // a second, of a file that does not say them
constexpr double kUsualAspect = 16.0 / 9;

GltfPlace place_of(const aiMatrix4x4& matrix, bool is_animated) {
  GltfPlace place;
  if (!is_animated) {
    place.matrix = dmat4_of(matrix);
    return place;
  }
  aiVector3D scale, translation;
  aiQuaternion turn;
  matrix.Decompose(scale, turn, translation);
  place.translation = dvec3_of(translation);
  place.scale = dvec3_of(scale);
  place.rotation = glm::dquat(turn.w, turn.x, turn.y, turn.z);
  return place;
}

std::vector<double> numbers_of(const aiVector3D& vector) { return {vector.x, vector.y, vector.z}; }
std::vector<double> numbers_of(const aiQuaternion& turn) { return {turn.x, turn.y, turn.z, turn.w}; }

class SceneMotionReader {
 public:
  SceneMotionReader(const std::filesystem::path& path, const std::string& animation)
      : path_(path), file_(path), scene_(file_.scene()), nodes_(scene_nodes(path, scene_)) {
    read_.animations = animations(animation);
    add_nodes();
    for (unsigned i = 0; i < scene_.mNumCameras; ++i) add_camera(*scene_.mCameras[i]);
    for (unsigned i = 0; i < scene_.mNumLights; ++i) add_light(*scene_.mLights[i]);
  }

  GltfScene read() { return std::move(read_); }

 private:
  GltfAnimations animations(const std::string& name) const {
    std::vector<std::string> names;
    for (unsigned i = 0; i < scene_.mNumAnimations; ++i) {
      names.emplace_back(scene_.mAnimations[i]->mName.C_Str());
      if (names.back().empty()) names.back() = "animation " + std::to_string(i + 1);
    }
    GltfAnimations all;
    const std::optional<std::size_t> shown = shown_animation(path_, names, name);
    if (shown) all.shown = animation_of(*scene_.mAnimations[*shown], names[*shown]);
    for (std::size_t i = 0; i < names.size(); ++i)
      if (i != shown) all.others.push_back(names[i]);
    return all;
  }

  GltfAnimation animation_of(const aiAnimation& given, const std::string& name) const {
    GltfAnimation animation{name, {}, given.mNumMorphMeshChannels, given.mNumMeshChannels};
    const double ticks = given.mTicksPerSecond > 0 ? given.mTicksPerSecond : kUsualTicks;
    for (const aiNodeAnim* moved : std::span(given.mChannels, given.mNumChannels)) {
      const auto node = nodes_.numbers.find(moved->mNodeName.C_Str());
      if (node == nodes_.numbers.end()) {
        ++animation.others;
        continue;
      }
      const auto add = [&](GltfPath what, auto* keys, unsigned count, std::size_t width) {
        if (count > 0) animation.channels.push_back(channel(node->second, what, std::span(keys, count), width, ticks));
      };
      add(GltfPath::translation, moved->mPositionKeys, moved->mNumPositionKeys, 3);
      add(GltfPath::rotation, moved->mRotationKeys, moved->mNumRotationKeys, 4);
      add(GltfPath::scale, moved->mScalingKeys, moved->mNumScalingKeys, 3);
    }
    return animation;
  }

  template <typename Key>
  GltfChannel channel(std::size_t node, GltfPath what, std::span<Key> keys, std::size_t width, double ticks) const {
    GltfChannel channel{node, what, GltfWay::linear, {}, {width, {}}};
    for (const Key& key : keys) {
      channel.times.push_back(key.mTime / ticks);
      for (const double number : numbers_of(key.mValue)) channel.values.numbers.push_back(number);
    }
    const auto is_finite = [](double number) { return std::isfinite(number); };
    if (!std::ranges::is_sorted(channel.times) || !std::ranges::all_of(channel.times, is_finite) ||
        !std::ranges::all_of(channel.values.numbers, is_finite))
      throw Failure("has an animation whose times do not ascend, or with numbers that are none", path_.string(),
                    "export it again");
    return channel;
  }

  void add_nodes() {
    std::vector<bool> is_animated(nodes_.nodes.size());
    if (read_.animations.shown)
      for (const GltfChannel& channel : read_.animations.shown->channels) is_animated[channel.node] = true;
    for (std::size_t node = 0; node < nodes_.nodes.size(); ++node)
      read_.nodes.places.push_back(place_of(nodes_.nodes[node]->mTransformation, is_animated[node] && node > 0));
    read_.nodes.places[0].matrix = nodes_.root;
    read_.nodes.parents = nodes_.parents;
    for (std::size_t node = 1; node < nodes_.nodes.size(); ++node)
      if (is_animated[node]) fold_pivots(node);
  }

  // Where FBX turns a node before and behind its own turn only, Assimp's pivots are of the file's pose, but its
  // channels of the node have all of its motion: the node then stands in its pivots' place. What turns it behind is in
  // the channels as its own inverse.
  void fold_pivots(std::size_t node) {
    const std::string prefix = nodes_.nodes[node]->mName.C_Str() + std::string(kPivot);
    aiMatrix4x4 all = nodes_.nodes[node]->mTransformation;
    for (std::size_t above = nodes_.parents[node];
         above != modeler::kNone && std::string_view(nodes_.nodes[above]->mName.C_Str()).starts_with(prefix);
         above = nodes_.parents[above]) {
      const aiNode& pivot = *nodes_.nodes[above];
      all = pivot.mTransformation * all;
      read_.nodes.places[above] = GltfPlace{.matrix = glm::dmat4(1)};
      if (std::string_view(pivot.mName.C_Str()).ends_with("_PostRotation")) turn_behind(node, pivot.mTransformation);
    }
    read_.nodes.places[node] = place_of(all, true);
  }

  void turn_behind(std::size_t node, const aiMatrix4x4& inverse) {
    const aiQuaternion turn((aiMatrix3x3(inverse)));
    for (GltfChannel& channel : read_.animations.shown->channels) {
      if (channel.node != node || channel.path != GltfPath::rotation) continue;
      std::vector<double>& n = channel.values.numbers;
      for (std::size_t i = 0; i + 3 < n.size(); i += 4) {
        const aiQuaternion key =
            aiQuaternion(float(n[i + 3]), float(n[i]), float(n[i + 1]), float(n[i + 2])) * turn * turn;
        std::ranges::copy(numbers_of(key), n.begin() + std::ptrdiff_t(i));
      }
    }
  }

  // A node that stands on the node `name`, at `place`, and looks along `ahead`; none where there is no such node.
  std::optional<std::size_t> looking(const aiString& name, const aiVector3D& place, const aiVector3D& ahead,
                                     const aiVector3D& up) {
    const auto node = nodes_.numbers.find(name.C_Str());
    const glm::dvec3 z = -dvec3_of(ahead);
    glm::dvec3 x = glm::cross(dvec3_of(up), z);
    if (!(glm::length(x) > 1e-6))
      x = glm::cross(std::abs(z.x) > std::abs(z.y) ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0), z);
    if (node == nodes_.numbers.end() || !(glm::length(x) > 0)) return std::nullopt;
    glm::dmat4 matrix(1);
    matrix[0] = glm::dvec4(glm::normalize(x), 0);
    matrix[1] = glm::dvec4(glm::normalize(glm::cross(z, x)), 0);
    matrix[2] = glm::dvec4(glm::normalize(z), 0);
    matrix[3] = glm::dvec4(dvec3_of(place), 1);
    read_.nodes.places.emplace_back().matrix = matrix;
    read_.nodes.parents.push_back(node->second);
    return read_.nodes.places.size() - 1;
  }

  void add_camera(const aiCamera& given) {
    const auto node = looking(given.mName, given.mPosition, given.mLookAt, given.mUp);
    if (!node) return;
    const double unit = elementary::cbrt(std::abs(glm::determinant(glm::dmat3(nodes_.root))));
    const double aspect = given.mAspect > 0 ? double(given.mAspect) : kUsualAspect;
    GltfCamera camera{*node, {}, 1, {}, {}, {}};
    if (given.mAspect > 0) camera.aspect = aspect;
    if (given.mOrthographicWidth > 0)
      camera.ymag = double(given.mOrthographicWidth) / aspect;
    else
      camera.yfov = 2 * elementary::atan(elementary::tan(double(given.mHorizontalFOV) / 2) / aspect);
    if (given.mClipPlaneNear > 0) camera.znear = double(given.mClipPlaneNear) * unit;
    if (given.mClipPlaneFar > 0) camera.zfar = double(given.mClipPlaneFar) * unit;
    if (!camera.yfov || *camera.yfov > 0) read_.cameras.push_back(camera);
  }

  void add_light(const aiLight& given) {
    const double intensity = std::max({given.mColorDiffuse.r, given.mColorDiffuse.g, given.mColorDiffuse.b});
    const bool is_known = given.mType == aiLightSource_DIRECTIONAL || given.mType == aiLightSource_POINT ||
                          given.mType == aiLightSource_SPOT;
    const auto node = is_known && intensity > 0 && std::isfinite(intensity)
                          ? looking(given.mName, given.mPosition, direction_of(given), given.mUp)
                          : std::nullopt;
    if (!node) {
      ++read_.unread_lights;
      return;
    }
    const aiColor3D color = given.mColorDiffuse;
    GltfLight light{*node, given.mType == aiLightSource_DIRECTIONAL ? GltfLightKind::directional
                           : given.mType == aiLightSource_SPOT      ? GltfLightKind::spot
                                                                    : GltfLightKind::point};
    light.color = glm::dvec3(color.r, color.g, color.b) / intensity;
    light.intensity = intensity;
    light.in_the_middle = true;
    light.inner = double(given.mAngleInnerCone) / 2;
    light.outer = double(given.mAngleOuterCone) / 2;
    read_.lights.push_back(light);
  }

  static aiVector3D direction_of(const aiLight& light) {
    return light.mDirection.SquareLength() > 0 ? light.mDirection : aiVector3D(0, 0, -1);
  }

  std::filesystem::path path_;
  LoadedScene file_;
  const aiScene& scene_;
  SceneNodes nodes_;
  GltfScene read_;
};

}  // namespace

GltfScene read_scene_motion(const std::filesystem::path& path, const std::string& animation) {
  return SceneMotionReader(path, animation).read();
}

}  // namespace mars::importer
