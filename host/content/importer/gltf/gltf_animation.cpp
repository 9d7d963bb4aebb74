#include "host/content/importer/gltf/gltf_animation.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include "hal/failure/failure.h"
#include "host/content/document/text.h"
#include "host/content/elementary/elementary.h"
#include "host/content/modeler/joint.h"

namespace mars::importer {
namespace {

constexpr double kSameTime = 1e-6;        // a share of the time
constexpr double kNearlyOne = 1 - 1e-12;  // cosine of the angle between two rotations that are one

constexpr std::array<std::pair<std::string_view, GltfPath>, 3> kPaths{
    {{"translation", GltfPath::translation}, {"rotation", GltfPath::rotation}, {"scale", GltfPath::scale}}};

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& problem, const std::string& remedy) {
  throw Failure(problem, path.string(), remedy);
}

template <std::size_t count>
std::array<double, count> numbers_of(const Tree& list, std::array<double, count> otherwise) {
  if (!list.is_array() || list.size() != count) return otherwise;
  for (std::size_t i = 0; i < count; ++i)
    if (list[i].is_number()) otherwise[i] = list[i].get<double>();
  return otherwise;
}

GltfPlace place_of(const Tree& node) {
  GltfPlace place;
  if (at(node, "matrix").is_array()) {
    const auto columns = numbers_of<16>(at(node, "matrix"), {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1});
    place.matrix.emplace();
    for (int i = 0; i < 16; ++i) (*place.matrix)[i / 4][i % 4] = columns[i];
    return place;
  }
  const auto t = numbers_of<3>(at(node, "translation"), {0, 0, 0}), s = numbers_of<3>(at(node, "scale"), {1, 1, 1});
  const auto r = numbers_of<4>(at(node, "rotation"), {0, 0, 0, 1});
  place.translation = {t[0], t[1], t[2]};
  place.scale = {s[0], s[1], s[2]};
  place.rotation = glm::dquat(r[3], r[0], r[1], r[2]);
  return place;
}

void refuse_circles(const std::filesystem::path& path, const std::vector<std::size_t>& parents) {
  std::vector<std::size_t> seen_from(parents.size(), modeler::kNone);
  for (std::size_t node = 0; node < parents.size(); ++node)
    for (std::size_t above = node; above != modeler::kNone && seen_from[above] == modeler::kNone;
         above = parents[above]) {
      seen_from[above] = node;
      if (parents[above] != modeler::kNone && seen_from[parents[above]] == node)
        refuse(path, "has nodes that are below themselves", "export it again");
    }
}

std::array<double, 4> normalized(std::array<double, 4> rotation) {
  double square = 0;
  for (const double number : rotation) square += number * number;
  if (!(square > 0)) return {0, 0, 0, 1};
  for (double& number : rotation) number /= std::sqrt(square);
  return rotation;
}

// Slerp by the shorter way (glTF 2.0, C.4).
std::array<double, 4> slerp(const std::array<double, 4>& from, std::array<double, 4> to, double part) {
  double cosine = 0;
  for (int i = 0; i < 4; ++i) cosine += from[i] * to[i];
  const double sign = cosine < 0 ? -1 : 1;
  cosine = std::abs(cosine);
  double a = 1 - part, b = part;
  if (cosine < kNearlyOne) {
    const double angle = elementary::acos(cosine);
    a = elementary::sin(angle * (1 - part)) / elementary::sin(angle);
    b = elementary::sin(angle * part) / elementary::sin(angle);
  }
  for (int i = 0; i < 4; ++i) to[i] = a * from[i] + b * sign * to[i];
  return normalized(to);
}

std::string name_of_animation(const Tree& animation, std::size_t number) {
  const Tree& name = at(animation, "name");
  return name.is_string() && !name.get_ref<const std::string&>().empty() ? name.get<std::string>()
                                                                         : "animation " + std::to_string(number + 1);
}

GltfChannel channel_of(const std::filesystem::path& path, const Tree& sampler, std::size_t node, GltfPath what,
                       const GltfBuffers& buffers) {
  const Tree& way = at(sampler, "interpolation");
  const std::string word = way.is_string() ? way.get<std::string>() : "LINEAR";
  GltfChannel channel{node,
                      what,
                      word == "STEP"          ? GltfWay::step
                      : word == "CUBICSPLINE" ? GltfWay::cubic
                                              : GltfWay::linear,
                      {},
                      buffers.read(at(sampler, "output"))};
  GltfNumbers times = buffers.read(at(sampler, "input"));
  if (times.width != 1) refuse(path, "has an animation whose times are no single numbers", "export it again");
  channel.times = std::move(times.numbers);
  const std::size_t width = what == GltfPath::rotation ? 4 : 3,
                    values = channel.times.size() * (channel.way == GltfWay::cubic ? 3 : 1);
  if (channel.times.empty() || channel.values.width != width || channel.values.count() != values)
    refuse(path, "has an animation with not one value for each of its times", "export it again");
  if (!std::ranges::is_sorted(channel.times))
    refuse(path, "has an animation whose times do not ascend", "export it again");
  return channel;
}

GltfAnimation animation_of(const std::filesystem::path& path, const Tree& gltf, const GltfBuffers& buffers,
                           const Tree& tree, const std::string& name) {
  GltfAnimation animation{name, {}};
  for (const Tree& each : at(tree, "channels")) {
    const Tree &target = at(each, "target"), &what = at(target, "path");
    const std::size_t node = number(at(target, "node"), modeler::kNone);
    const std::string word = what.is_string() ? what.get<std::string>() : "";
    const auto way = std::ranges::find(kPaths, word, &std::pair<std::string_view, GltfPath>::first);
    if (word == "weights")
      ++animation.weights;
    else if (node >= at(gltf, "nodes").size() || way == kPaths.end())
      ++animation.others;
    else
      animation.channels.push_back(
          channel_of(path, item(at(tree, "samplers"), at(each, "sampler")), node, way->second, buffers));
  }
  return animation;
}

}  // namespace

glm::dmat4 GltfPlace::local() const {
  if (matrix) return *matrix;
  const double length = glm::length(rotation);
  const glm::dmat3 turn = length > 0 ? glm::mat3_cast(rotation / length) : glm::dmat3(1);
  glm::dmat4 all(1);
  for (int column = 0; column < 3; ++column) all[column] = glm::dvec4(turn[column] * scale[column], 0);
  all[3] = glm::dvec4(translation, 1);
  return all;
}

std::array<double, 4> GltfChannel::at(double time) const {
  const bool cubic = way == GltfWay::cubic;
  const auto value = [&](std::size_t key, std::size_t part) {  // part: of a cubic one
    std::array<double, 4> read{};
    std::copy_n(values.element(cubic ? key * 3 + part : key), values.width, read.begin());
    return read;
  };
  const auto finished = [&](const std::array<double, 4>& read) {
    return path == GltfPath::rotation ? normalized(read) : read;
  };
  const double reached = way == GltfWay::step ? time * (1 + kSameTime) : time;
  const auto later = static_cast<std::size_t>(std::ranges::upper_bound(times, reached) - times.begin());
  if (later == 0) return finished(value(0, 1));
  if (later == times.size() || way == GltfWay::step) return finished(value(later - 1, 1));
  const double length = times[later] - times[later - 1], t = (time - times[later - 1]) / length;
  const auto from = value(later - 1, 1), to = value(later, 1);
  if (way == GltfWay::linear && path == GltfPath::rotation) return slerp(normalized(from), normalized(to), t);
  std::array<double, 4> between{};
  const auto leave = value(later - 1, 2), reach = value(later, 0);
  for (std::size_t i = 0; i < values.width; ++i)
    between[i] = cubic ? (2 * t * t * t - 3 * t * t + 1) * from[i] + length * (t * t * t - 2 * t * t + t) * leave[i] +
                             (-2 * t * t * t + 3 * t * t) * to[i] + length * (t * t * t - t * t) * reach[i]
                       : (1 - t) * from[i] + t * to[i];
  return finished(between);
}

double GltfAnimation::end() const {
  double greatest = 0;
  for (const GltfChannel& channel : channels) greatest = std::max(greatest, channel.times.back());
  return greatest;
}

std::optional<std::size_t> shown_animation(const std::filesystem::path& path, const std::vector<std::string>& names,
                                           const std::string& name) {
  const auto found = name.empty() ? names.begin() : std::ranges::find(names, name);
  if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  if (name.empty()) return std::nullopt;
  refuse(path, "has no animation '" + document::printable(name) + "'",
         names.empty() ? "leave out --animation: it has none"
                       : "it has: " + document::printable(document::joined(names), 400));
}

GltfNodes gltf_nodes(const std::filesystem::path& path, const Tree& gltf) {
  GltfNodes nodes;
  const Tree& list = at(gltf, "nodes");
  nodes.parents.assign(list.size(), modeler::kNone);
  for (std::size_t node = 0; node < list.size(); ++node) {
    nodes.places.push_back(place_of(list[node]));
    for (const std::size_t child : places_in(list, at(list[node], "children"))) nodes.parents[child] = node;
  }
  refuse_circles(path, nodes.parents);
  return nodes;
}

GltfAnimations gltf_animations(const std::filesystem::path& path, const Tree& gltf, const GltfBuffers& buffers,
                               const std::string& name) {
  const Tree& trees = at(gltf, "animations");
  GltfAnimations animations;
  std::vector<std::string> names;
  for (const Tree& tree : trees) names.push_back(name_of_animation(tree, names.size()));
  const std::optional<std::size_t> shown = shown_animation(path, names, name);
  std::size_t number = 0;
  for (const Tree& tree : trees) {
    if (number == shown)
      animations.shown = animation_of(path, gltf, buffers, tree, names[number]);
    else
      animations.others.push_back(names[number]);
    ++number;
  }
  return animations;
}

GltfNodes moved(GltfNodes nodes, const GltfAnimation& animation, double time) {
  for (const GltfChannel& channel : animation.channels) {
    const auto value = channel.at(time);
    GltfPlace& place = nodes.places[channel.node];
    place.matrix.reset();
    if (channel.path == GltfPath::translation) place.translation = {value[0], value[1], value[2]};
    if (channel.path == GltfPath::rotation) place.rotation = glm::dquat(value[3], value[0], value[1], value[2]);
    if (channel.path == GltfPath::scale) place.scale = {value[0], value[1], value[2]};
  }
  return nodes;
}

std::vector<glm::dmat4> gltf_matrices(const GltfNodes& nodes) {
  std::vector<glm::dmat4> matrices(nodes.places.size(), glm::dmat4(1));
  std::vector<bool> done(nodes.places.size());
  for (std::size_t node = 0; node < nodes.places.size(); ++node) {
    std::vector<std::size_t> way;
    std::size_t above = node;
    for (; above != modeler::kNone && !done[above]; above = nodes.parents[above]) way.push_back(above);
    for (; !way.empty(); way.pop_back()) {
      const std::size_t parent = nodes.parents[way.back()];
      const glm::dmat4 local = nodes.places[way.back()].local();
      matrices[way.back()] = parent == modeler::kNone ? local : matrices[parent] * local;
      done[way.back()] = true;
    }
  }
  return matrices;
}

}  // namespace mars::importer
