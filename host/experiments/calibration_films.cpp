#include "host/experiments/calibration_films.h"

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string_view>
#include <utility>

#include "host/content/elementary/elementary.h"

namespace mars::experiments {
namespace {

using nlohmann::json;

// Bodies differ from their neighbours, as the parts of figures do.
constexpr const char* kMixed = "mixed";
constexpr const char* kLinear = "linear";
constexpr const char* kDual = "dual-quaternions";
constexpr std::array kShapes{"sphere", "cylinder", "cone", "box"};
constexpr std::array kReflections{"phong", "blinn-phong", "cook-torrance"};

struct Bodies {
  const char* name;
  const char* shape;
  int side;  // rows, and bodies in each row
  double size;
  int dice;  // 0: adaptive
  const char* reflection;
  const char* interpolation;
  int lights;
  int samples;
  const char* extent;
  int casting = 0;              // of its lights, the first
  double width = 0;             // in degrees, of the first
  bool outside = false;         // as many again cast shadows from outside the picture
  const char* blend = nullptr;  // of their skins
};

constexpr Bodies kBodies[] = {
    {"cube", "box", 1, 6, 0, "phong", "phong", 1, 1, "1280x720"},
    {"cubes", "box", 3, 2, 0, "blinn-phong", "phong", 3, 4, "960x540"},
    {"crowd", kMixed, 12, 0.7, 0, kMixed, "phong", 3, 4, "480x270"},
    {"figures", kMixed, 7, 1.2, 0, kMixed, "phong", 3, 1, "960x540"},
    {"people", kMixed, 16, 0.6, 0, kMixed, "phong", 2, 1, "640x360"},
    {"group", kMixed, 5, 1.8, 0, kMixed, "phong", 3, 4, "960x540"},
    {"boxes", "box", 24, 0.2, 0, "phong", "phong", 2, 1, "320x180"},
    {"still", "sphere", 12, 0.5, 0, "phong", "phong", 2, 1, "640x360"},
    {"balls", "sphere", 4, 1.7, 0, "blinn-phong", "phong", 3, 1, "1280x720"},
    {"fine", "sphere", 2, 3.4, 64, "phong", "phong", 1, 1, "640x360"},
    {"small", "teapot", 3, 1.6, 0, "phong", "phong", 3, 4, "320x180"},
    {"teapots", "teapot", 3, 1.6, 0, "metallic-roughness", "phong", 2, 4, "640x360"},
    {"teapot", "teapot", 1, 6, 0, "cook-torrance", "phong", 3, 1, "960x540"},
    {"smooth", "teapot", 1, 6, 0, "cook-torrance", "phong", 2, 16, "480x270"},
    {"lit", "teapot", 1, 6, 0, "blinn-phong", "phong", 4, 4, "960x540"},
    {"many", "sphere", 20, 0.3, 0, "phong", "phong", 1, 4, "480x270"},
    {"grains", "sphere", 6, 0.6, 32, "phong", "phong", 1, 16, "320x180"},
    {"colored", "teapot", 2, 2.5, 0, "blinn-phong", "gouraud", 4, 1, "640x360"},
    {"sheet", "sheet", 1, 6, 0, "phong", "phong", 2, 4, "640x360"},
    {"sheets", "sheet", 4, 1.5, 0, "blinn-phong", "phong", 3, 1, "480x270"},
    {"cloth", "sheet", 2, 3, 0, "metallic-roughness", "phong", 3, 1, "1280x720"},
    {"hills", "hills", 2, 3, 1, "phong", "phong", 2, 1, "960x540"},
    {"dunes", "hills", 8, 0.8, 1, "cook-torrance", "phong", 1, 4, "640x360"},
    {"stones", "stone", 16, 0.4, 1, "cook-torrance", "phong", 3, 1, "640x360"},
    {"rubble", "stone", 10, 0.6, 1, "phong", "phong", 2, 16, "320x180"},
    {"facets", "hills", 4, 1.6, 1, "blinn-phong", "flat", 3, 4, "480x270"},
    {"shade", kMixed, 7, 1.2, 0, kMixed, "phong", 3, 4, "640x360", 1},
    {"shades", "teapot", 3, 1.6, 0, "phong", "phong", 2, 1, "960x540", 2},
    {"shadows", "sphere", 16, 0.4, 0, "blinn-phong", "phong", 1, 16, "320x180", 1},
    {"lantern", kMixed, 5, 1.8, 0, kMixed, "phong", 3, 4, "320x180", 3},
    {"lanterns", "stone", 12, 0.5, 1, "cook-torrance", "phong", 4, 1, "640x360", 4},
    {"ridges", "hills", 2, 3, 1, "phong", "phong", 1, 4, "480x270", 1},
    {"dusk", "teapot", 2, 2.5, 0, "phong", "phong", 1, 4, "320x180", 1, 2},
    {"outside", "teapot", 3, 1.6, 0, "phong", "phong", 2, 4, "480x270", 1, 0, true},
    {"beyond", "sphere", 12, 0.4, 0, "phong", "phong", 1, 1, "480x270", 1, 0, true},
    {"skins", "hills", 5, 1.3, 1, "phong", "phong", 2, 1, "480x270", 0, 0, false, kLinear},
    {"herd", "stone", 14, 0.45, 1, "phong", "phong", 1, 1, "320x180", 0, 0, false, kLinear},
    {"duals", "hills", 5, 1.3, 1, "phong", "phong", 2, 1, "480x270", 0, 0, false, kDual},
    {"flock", "stone", 14, 0.45, 1, "phong", "phong", 1, 1, "320x180", 0, 0, false, kDual},
    {"nets", "sheet", 3, 2, 0, "phong", "phong", 2, 1, "480x270", 0, 0, false, kLinear},
    {"capes", "sheet", 8, 0.8, 0, "phong", "phong", 1, 1, "320x180", 0, 0, false, kDual},
};

double wave(double x, double y) {
  return 0.5 + 0.4 * elementary::sin(4 * std::numbers::pi * x) * elementary::cos(6 * std::numbers::pi * y);
}

// Of four joints, of a place from 0 to 1 along the shape: those of the skin's ends and middle.
json bones_at(double along) {
  const double middle = 1 - std::abs(2 * along - 1);
  return along < 0.5 ? json{0, 1 - along, 1, middle, 2, 0.2} : json{1, middle + 0.1, 2, along, 3, along - 0.4};
}

// A wavy mesh of `side` times `side` squares, within 0 to 1; `has_bones`: for a skin.
json mesh(int side, bool has_bones) {
  json vertices = json::array(), faces = json::array(), bones = json::array();
  for (int i = 0; i <= side; ++i)
    for (int j = 0; j <= side; ++j) {
      const double x = static_cast<double>(i) / side, y = static_cast<double>(j) / side;
      vertices.push_back({x, y, wave(x, y)});
      bones.push_back(bones_at(x));
    }
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j) {
      const int at = i * (side + 1) + j;
      faces.push_back({at, at + side + 1, at + side + 2, at + 1});
    }
  json mesh = {{"vertices", std::move(vertices)}, {"faces", std::move(faces)}, {"crease", 180}};
  if (has_bones) mesh["bones"] = std::move(bones);
  return {{"mesh", std::move(mesh)}};
}

// Many patches.
json sheet(bool has_bones) {
  constexpr int kSide = 15;
  json rows = json::array(), bones = json::array();
  for (int i = 0; i <= kSide; ++i) {
    json row = json::array();
    for (int j = 0; j <= kSide; ++j) {
      const double x = static_cast<double>(i) / kSide, y = static_cast<double>(j) / kSide;
      row.push_back({x, y, wave(x, y)});
    }
    rows.push_back(row);
    bones.push_back(json(std::vector<json>(kSide + 1, bones_at(static_cast<double>(i) / kSide))));
  }
  json sheet = {{"points", rows}};
  if (has_bones) sheet["bones"] = bones;
  return {{"bspline", sheet}};
}

// Null: the library has the shape.
json own_shape(std::string_view name, bool has_bones) {
  if (name == "hills") return mesh(48, has_bones);
  if (name == "stone") return mesh(3, has_bones);
  if (name == "sheet") return sheet(has_bones);
  return nullptr;
}

json lights(const Bodies& bodies) {
  json all[] = {{{"direction", {-0.4, -0.7, 0.8}}},
                {{"direction", {0.9, -0.2, 0.3}}, {"intensity", 0.5}},
                {{"place", {4, -6, 5}}, {"intensity", 0.7}, {"reach", 12}},
                {{"place", {-5, -4, 3}}, {"intensity", 0.4}, {"reach", 10}}};
  for (int i = 0; i < bodies.casting; ++i) all[i]["shadow"] = true;
  if (bodies.width > 0) all[0]["size"] = bodies.width;
  return json(std::vector<json>(all, all + bodies.lights));
}

// On the way to the first light, out of the camera's sight.
constexpr std::array<double, 3> kOutside{-3.6, -6.3, 7.2};

// Every second one turns.
void add_actors(json& all, const Bodies& bodies, std::size_t models, const char* names,
                const std::array<double, 3>& center) {
  for (int i = 0; i < bodies.side * bodies.side; ++i) {
    const double step = 6.5 / bodies.side;
    const double x = (i % bodies.side + 0.5) * step - 3.25, z = (static_cast<double>(i) / bodies.side) * step - 3.0;
    json actor = {{"name", names + std::to_string(i)},
                  {"model", "body" + std::to_string(static_cast<std::size_t>(i) % models)},
                  {"place", {center[0] + x, center[1], center[2] + z}}};
    if (i % 2 == 1 || bodies.side == 1)
      actor["keys"] = {{{"frame", 0}, {"turn", {0, 0, 0}}}, {{"frame", 8}, {"turn", {0, 0, 160}}}};
    all.push_back(actor);
  }
}

json actors(const Bodies& bodies, std::size_t models) {
  json all = json::array();
  add_actors(all, bodies, models, "a", {0, 0, 0});
  if (bodies.outside) add_actors(all, bodies, models, "outside", kOutside);
  if (bodies.casting > 0) all.push_back({{"name", "wall"}, {"model", "wall"}});
  return all;
}

json model(const Bodies& bodies, const std::string& shape, const std::string& reflection) {
  const double half = bodies.size / 2;
  json segment = {{"shape", shape}, {"sbb", {{-half, -half, -half}, {half, half, half}}}, {"material", "skin"}};
  json bones = json::array();
  if (bodies.blend != nullptr) {
    segment["skin"] = {{"joints", {"body", "bone1", "bone2", "bone3"}}, {"blend", bodies.blend}};
    for (const char* name : {"bone1", "bone2", "bone3"}) bones.push_back({{"name", name}, {"parent", "body"}});
  }
  json model = {{"joints", {{{"name", "body"}, {"segment", segment}}}}};
  model["joints"].insert(model["joints"].end(), bones.begin(), bones.end());
  json own = own_shape(shape, bodies.blend != nullptr);
  if (!own.is_null()) model["shapes"] = {{shape, std::move(own)}};
  model["materials"]["skin"] = {
      {"color", {0.7, 0.5, 0.3}}, {"reflection", reflection}, {"interpolation", bodies.interpolation}};
  return model;
}

// Behind the bodies, for their shadows.
json wall() {
  const json segment = {{"shape", "box"}, {"sbb", {{-4, 1.5, -4}, {4, 1.7, 4}}}, {"material", "plaster"}};
  return {{"joints", {{{"name", "wall"}, {"segment", segment}}}}, {"materials", {{"plaster", json::object()}}}};
}

json bodies_of(const Bodies& bodies) {
  if (std::string_view(bodies.shape) != kMixed) return {{"body0", model(bodies, bodies.shape, bodies.reflection)}};
  json all;
  for (std::size_t i = 0; i < kShapes.size() * kReflections.size(); ++i)
    all["body" + std::to_string(i)] = model(bodies, kShapes[i % kShapes.size()], kReflections[i % kReflections.size()]);
  return all;
}

std::string film_text(const Bodies& bodies) {
  const json ambient = {{"sky", {0.8, 0.9, 1}}, {"ground", {0.5, 0.45, 0.4}}};
  json models = bodies_of(bodies);
  json all_actors = actors(bodies, models.size());
  if (bodies.casting > 0) models["wall"] = wall();
  return json({{"frames", 8},
               {"ambient", ambient},
               {"dice", bodies.dice == 0 ? json("adaptive") : json(bodies.dice)},
               {"camera", {{"eye", {0, -14, 4}}, {"at", {0, 0, 0}}, {"fov", 34}}},
               {"lights", lights(bodies)},
               {"models", std::move(models)},
               {"actors", std::move(all_actors)}})
      .dump(1);
}

}  // namespace

std::vector<CalibrationFilm> calibration_films() {
  std::vector<CalibrationFilm> films;
  for (const Bodies& bodies : kBodies)
    films.push_back({bodies.name,
                     film_text(bodies),
                     {"--samples", std::to_string(bodies.samples), "--size", bodies.extent, "--frames", "0-3"}});
  return films;
}

}  // namespace mars::experiments
