#include "host/experiments/calibration_films.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

namespace mars::experiments {
namespace {

using nlohmann::json;

struct Bodies {
  const char* name;
  const char* shape;
  int side;  // so many rows of so many bodies
  double size;
  int dice;
  const char* reflection;
  const char* interpolation;
  int lights;
  int samples;
  const char* extent;
};

constexpr Bodies kBodies[] = {
    {"cube", "box", 1, 6, 1, "phong", "phong", 1, 1, "1280x720"},
    {"cubes", "box", 3, 2, 1, "blinn-phong", "phong", 3, 4, "960x540"},
    {"still", "sphere", 12, 0.5, 4, "phong", "phong", 2, 1, "640x360"},
    {"balls", "sphere", 4, 1.7, 16, "blinn-phong", "phong", 1, 1, "1280x720"},
    {"fine", "sphere", 2, 3.4, 64, "phong", "phong", 1, 1, "640x360"},
    {"teapots", "teapot", 3, 1.6, 16, "metallic-roughness", "phong", 2, 4, "640x360"},
    {"teapot", "teapot", 1, 6, 32, "cook-torrance", "phong", 3, 1, "960x540"},
    {"smooth", "teapot", 1, 6, 16, "cook-torrance", "phong", 2, 16, "480x270"},
    {"many", "sphere", 20, 0.3, 6, "phong", "phong", 1, 4, "480x270"},
    {"grains", "sphere", 6, 0.6, 32, "phong", "phong", 1, 16, "320x180"},
    {"colored", "teapot", 2, 2.5, 24, "blinn-phong", "gouraud", 4, 1, "640x360"},
    {"hills", "hills", 2, 3, 1, "phong", "phong", 2, 1, "960x540"},
    {"stones", "hills", 8, 0.8, 1, "cook-torrance", "phong", 1, 4, "640x360"},
    {"facets", "hills", 4, 1.6, 1, "blinn-phong", "flat", 3, 4, "480x270"},
};

// A wavy mesh of squares, within 0 to 1.
json hills() {
  constexpr int kSide = 48;
  json vertices = json::array(), faces = json::array();
  for (int i = 0; i <= kSide; ++i)
    for (int j = 0; j <= kSide; ++j) {
      const double x = static_cast<double>(i) / kSide, y = static_cast<double>(j) / kSide;
      const double wave = std::sin(4 * std::numbers::pi * x) * std::cos(6 * std::numbers::pi * y);
      vertices.push_back({x, y, 0.5 + 0.4 * wave});
    }
  for (int i = 0; i < kSide; ++i)
    for (int j = 0; j < kSide; ++j) {
      const int at = i * (kSide + 1) + j;
      faces.push_back({at, at + kSide + 1, at + kSide + 2, at + 1});
    }
  return {{"mesh", {{"vertices", vertices}, {"faces", faces}, {"crease", 180}}}};
}

json lights(int count) {
  const json all[] = {{{"direction", {-0.4, -0.7, 0.8}}},
                      {{"direction", {0.9, -0.2, 0.3}}, {"intensity", 0.5}},
                      {{"place", {4, -6, 5}}, {"intensity", 0.7}, {"reach", 12}},
                      {{"place", {-5, -4, 3}}, {"intensity", 0.4}, {"reach", 10}}};
  return json(std::vector<json>(all, all + count));
}

// Every second one turns.
json actors(const Bodies& bodies) {
  json all = json::array();
  for (int i = 0; i < bodies.side * bodies.side; ++i) {
    const double step = 6.5 / bodies.side;
    const double x = (i % bodies.side + 0.5) * step - 3.25, z = (static_cast<double>(i) / bodies.side) * step - 3.0;
    json actor = {{"name", "a" + std::to_string(i)}, {"model", "body"}, {"place", {x, 0, z}}};
    if (i % 2 == 1 || bodies.side == 1)
      actor["keys"] = {{{"frame", 0}, {"turn", {0, 0, 0}}}, {{"frame", 8}, {"turn", {0, 0, 160}}}};
    all.push_back(actor);
  }
  return all;
}

std::string film_text(const Bodies& bodies) {
  const double half = bodies.size / 2;
  const json segment = {
      {"shape", bodies.shape}, {"sbb", {{-half, -half, -half}, {half, half, half}}}, {"material", "skin"}};
  json model = {{"joints", {{{"name", "body"}, {"segment", segment}}}}};
  if (std::string_view(bodies.shape) == "hills") model["shapes"] = {{"hills", hills()}};
  const json material = {
      {"color", {0.7, 0.5, 0.3}}, {"reflection", bodies.reflection}, {"interpolation", bodies.interpolation}};
  return json({{"frames", 8},
               {"dice", bodies.dice},
               {"camera", {{"eye", {0, -14, 4}}, {"at", {0, 0, 0}}, {"fov", 34}}},
               {"lights", lights(bodies.lights)},
               {"materials", {{"skin", material}}},
               {"models", {{"body", model}}},
               {"actors", actors(bodies)}})
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
