#include "host/experiments/trials/trial_films.h"

#include <array>
#include <nlohmann/json.hpp>
#include <random>
#include <span>

#include "host/content/elementary/elementary.h"

namespace mars::trials {
namespace {

using nlohmann::json;

constexpr int kFrames = 96;

constexpr std::array kShapes{"box",   "sphere", "cylinder",  "cone",   "capsule", "rounded_box",
                             "torus", "disc",   "ellipsoid", "teapot", "hull",    "sail"};
constexpr std::array kReflections{"phong", "blinn-phong", "cook-torrance", "metallic-roughness"};
constexpr std::array kInterpolations{"phong", "phong", "phong", "gouraud", "flat"};
constexpr std::array kSamples{1, 1, 2, 4, 4, 4, 8, 16};
constexpr std::array kWidths{320, 480, 640, 800, 960, 1280};

// Numbers alike on every machine, which standard distributions are not.
class Chance {
 public:
  explicit Chance(std::uint32_t seed) : engine_(seed) {}

  double number(double least, double most) { return least + (most - least) * (engine_() / 4294967296.0); }
  int count(int least, int most) { return least + static_cast<int>(number(0, most - least + 1)); }
  bool happens(double part) { return number(0, 1) < part; }
  template <typename List>
  auto one_of(const List& list) {
    return list[static_cast<std::size_t>(count(0, static_cast<int>(list.size()) - 1))];
  }
  json vector(double reach) { return {number(-reach, reach), number(-reach, reach), number(-reach, reach)}; }
  json color(double least) { return {number(least, 1), number(least, 1), number(least, 1)}; }

 private:
  std::mt19937 engine_;
};

// A wavy mesh of triangles, two on each of `side` times `side` squares, or control points of a surface.
json waves(int side, bool mesh) {
  json vertices = json::array(), faces = json::array(), rows = json::array();
  for (int i = 0; i <= side; ++i) {
    json row = json::array();
    for (int j = 0; j <= side; ++j) {
      const double x = static_cast<double>(i) / side, y = static_cast<double>(j) / side;
      row.push_back({x, y, 0.5 + 0.4 * elementary::sin(9 * x) * elementary::cos(14 * y)});
      const int at = i * (side + 1) + j;
      if (i == side || j == side) continue;
      faces.push_back({at, at + side + 1, at + side + 2});
      faces.push_back({at, at + side + 2, at + 1});
    }
    vertices.insert(vertices.end(), row.begin(), row.end());
    rows.push_back(row);
  }
  if (mesh) return {{"mesh", {{"vertices", vertices}, {"faces", faces}, {"crease", 180}}}};
  return {{"bspline", {{"points", rows}}}};
}

class Maker {
 public:
  explicit Maker(std::uint32_t seed) : chance_(seed) {}

  std::string film() {
    const int width = chance_.one_of(kWidths);
    json film = {{"frames", kFrames},
                 {"size", {width, width * chance_.count(8, 14) / 16}},
                 {"samples", chance_.one_of(kSamples)},
                 {"camera", camera()},
                 {"lights", list(chance_.count(1, 4), [this](int) { return light(); })}};
    if (chance_.happens(0.3)) film["dice"] = chance_.count(2, 16);
    if (chance_.happens(0.5)) film["ambient"] = {{"sky", chance_.color(0.3)}, {"ground", chance_.color(0.2)}};
    if (chance_.happens(0.3)) film["fog"] = {{"start", chance_.number(2, 5)}, {"end", chance_.number(9, 40)}};
    const int models = chance_.count(1, 4);
    for (int i = 0; i < models; ++i) film["models"]["m" + std::to_string(i)] = model();
    film["actors"] = list(chance_.count(1, 8), [&](int i) { return actor(i, models); });
    return film.dump(1);
  }

 private:
  template <typename Make>
  static json list(int count, const Make& make) {
    json all = json::array();
    for (int i = 0; i < count; ++i) all.push_back(make(i));
    return all;
  }

  // A camera that moves leaves no inbetweens.
  json camera() {
    json camera = {{"eye", {chance_.number(-3, 3), chance_.number(-7, -3), chance_.number(0, 3)}}, {"at", {0, 0, 0}}};
    if (!chance_.happens(0.25))
      camera["fov"] = chance_.number(30, 60);
    else
      camera["keys"] = keys("fov", [this] { return chance_.number(30, 60); });
    if (chance_.happens(0.2)) camera.update({{"projection", "orthographic"}, {"height", chance_.number(2, 8)}});
    if (chance_.happens(0.2)) camera["shift"] = {chance_.number(-0.5, 0.5), chance_.number(-0.5, 0.5)};
    return camera;
  }

  json light() {
    json light = {{"color", chance_.color(0.5)}, {"intensity", chance_.number(0.5, 2)}};
    if (chance_.happens(0.5)) {
      light["direction"] = {chance_.number(-1, 1), chance_.number(-1, 0), chance_.number(0.3, 1)};
      return light;
    }
    light["place"] = {chance_.number(-4, 4), chance_.number(-5, 1), chance_.number(1, 4)};
    light["reach"] = chance_.number(3, 12);
    if (chance_.happens(0.4)) light.update({{"at", chance_.vector(1)}, {"cone", {20, 45}}});
    return light;
  }

  json material() {
    return {{"color", chance_.color(0.2)},
            {"reflection", chance_.one_of(kReflections)},
            {"interpolation", chance_.one_of(kInterpolations)},
            {"sides", chance_.count(1, 2)}};
  }

  // Joints that hang on each other, each with a segment.
  json model() {
    json model = {
        {"shapes", {{"hull", waves(chance_.count(3, 40), true)}, {"sail", waves(chance_.count(4, 12), false)}}},
        {"materials", {{"a", material()}, {"b", material()}}}};
    const double size = chance_.number(0.3, 1.6);
    const auto joint = [&](int i) {
      const json low = {-size / 2, -size / 2, -size / 2};
      const json high = {chance_.number(0.1, size), chance_.number(0.1, size), chance_.number(0.1, size)};
      json joint = {{"name", "j" + std::to_string(i)},
                    {"place", chance_.vector(size / 2)},
                    {"segment",
                     {{"shape", chance_.one_of(kShapes)}, {"sbb", {low, high}}, {"material", i % 2 == 0 ? "a" : "b"}}}};
      if (i > 0) joint["parent"] = "j" + std::to_string(chance_.count(0, i - 1));
      return joint;
    };
    model["joints"] = list(chance_.count(1, 8), joint);
    return model;
  }

  // Some stand still.
  json actor(int number, int models) {
    json actor = {{"name", "a" + std::to_string(number)},
                  {"model", "m" + std::to_string(chance_.count(0, models - 1))}};
    if (chance_.happens(0.4))
      actor["place"] = chance_.vector(1.8);
    else
      actor["keys"] = moves();
    return actor;
  }

  json moves() {
    json keys = this->keys("place", [this] { return chance_.vector(1.8); });
    for (json& key : keys) {
      key["turn"] = chance_.vector(180);
      key["pose"] = {{"j0", chance_.vector(60)}};
    }
    return keys;
  }

  template <typename Make>
  json keys(const char* name, const Make& make) {
    json keys = json::array();
    for (int frame = 0; frame <= kFrames; frame += chance_.count(6, 60))
      keys.push_back({{"frame", frame}, {name, make()}});
    return keys;
  }

  Chance chance_;
};

}  // namespace

std::vector<TrialFilm> trial_films(int count) {
  std::vector<TrialFilm> films;
  for (int i = 0; i < count; ++i)
    films.push_back({"trial" + std::to_string(i), Maker(static_cast<std::uint32_t>(i)).film()});
  return films;
}

}  // namespace mars::trials
