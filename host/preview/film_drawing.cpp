#include "host/preview/film_drawing.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "host/content/elementary/elementary.h"

namespace mars::preview {
namespace {

constexpr Placing kWorld{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
constexpr double kBehind = 0.01;  // of the subject's radius: lines on a surface are before it
constexpr Color kGround{0.30f, 0.33f, 0.38f};

// 1, 2 or 5 times a power of ten, such that about ten of them make `extent`.
double grid_step(double extent) {
  const double power = elementary::pow(10, std::floor(elementary::log10(extent / 10)));
  for (const double times : {1.0, 2.0, 5.0})
    if (times * power >= extent / 10) return times * power;
  return 10 * power;
}

// Lines at z = 0 under the ball, to whole steps.
Lines ground_under(const Ball& ball) {
  Lines grid;
  const double step = grid_step(2 * std::max(ball.radius, 1e-6));
  const auto count = static_cast<int>(std::ceil(ball.radius / step));
  const double x = std::round(ball.center.x / step) * step, y = std::round(ball.center.y / step) * step;
  const auto add = [&](double px, double py) {
    grid.points.insert(grid.points.end(), {static_cast<float>(x + px), static_cast<float>(y + py), 0.0f});
  };
  for (int i = -count; i <= count; ++i) {
    const double at = i * step, end = count * step;
    add(at, -end);
    add(at, end);
    add(-end, at);
    add(end, at);
  }
  for (std::uint32_t point = 0; point < grid.points.size() / 3; ++point) grid.ends.push_back(point);
  return grid;
}

// Half way to the paper.
Color dim(Color color) {
  for (std::size_t i = 0; i < 3; ++i) color[i] = 0.5f * (color[i] + kPaper[i]);
  return color;
}

// Three quarters of the way to white.
Color bright(Color color) {
  for (float& part : color) part = 0.25f * part + 0.75f;
  return color;
}

// None where the film has it.
std::optional<Placing> posed_placing(const Part& part, const Posed& posed) {
  const auto figure = posed.figures.find(part.joint.actor);
  if (figure == posed.figures.end()) return std::nullopt;
  const auto& segment = figure->second.segments[part.joint.joint];
  return segment ? placing(*segment) : placing(figure->second.joints[part.joint.joint]);
}

// Of a skin's lines, in the world.
Lines bent(const Lines& lines, const modeler::BentSkin& skin) {
  Lines moved{{}, lines.ends, lines.dots};
  const auto add = [&](const glm::dvec3& place) {
    for (int axis = 0; axis < 3; ++axis) moved.points.push_back(static_cast<float>(place[axis]));
  };
  const std::vector<glm::dvec3> means = skin.means_of(lines.net);
  for (const std::uint32_t mean : lines.means) add(means[mean]);
  for (std::size_t point = 0; point < lines.bones.size(); ++point) {
    const float* const from = &lines.points[3 * (lines.means.size() + point)];
    add(skin.place_of({from[0], from[1], from[2]}, lines.bones[point]));
  }
  return moved;
}

double distance_along(const wire::Camera& camera, const glm::dvec3& place) {
  const auto& row = camera.world_to_eye.m[2];
  return -(row[0] * place.x + row[1] * place.y + row[2] * place.z + row[3]);
}

}  // namespace

Color line_color(const Color& color) {
  constexpr float kDarkest = 0.62f;
  const float brightest = std::max({color[0], color[1], color[2]});
  if (brightest >= kDarkest) return color;
  if (brightest < 0.05f) return {kDarkest, kDarkest, kDarkest};
  Color lifted;
  for (std::size_t i = 0; i < 3; ++i) lifted[i] = color[i] * kDarkest / brightest;
  return lifted;
}

FilmDrawing::FilmDrawing(const Wireframe& wireframe) : wireframe_(wireframe), grid_(ground_under(wireframe.subject)) {
  for (const Part& part : wireframe.parts[0]) moving_ = moving_ || part.motion.count > 1;
}

void FilmDrawing::draw(Drawing& drawing, As as, std::uint32_t frame, const wire::Camera& camera, std::uint32_t pen,
                       bool ground, std::span<const Cover> covers, const Posed& posed) const {
  const double middle = distance_along(camera, wireframe_.subject.center);
  drawing.begin(camera, kPaper, middle - wireframe_.subject.radius, middle + wireframe_.subject.radius);
  for (const Cover& cover : covers) drawing.cover(*cover.facets, cover.to_world, kBehind * wireframe_.subject.radius);
  if (ground) drawing.draw(grid_, kWorld, kGround, {pen, 1});
  const bool small = drawing.image().height < 200 * pen;  // a terminal's characters: dots would hide all else
  const Stroke sticks{pen > 1 && !small ? 2 * pen : pen, small ? pen + 1 : 3 * pen};
  const Stroke thin{pen, small ? 1 : pen + 1};
  for (const Part& part : wireframe_.parts[static_cast<std::size_t>(as)]) {
    Color color = line_color(wireframe_.colors[wireframe_.value_at(part.look, frame)]);
    const bool selected = part.joint.joint != modeler::kNone && part.joint == posed.selected;
    const Placing& in_film = wireframe_.matrices[wireframe_.value_at(part.motion, frame)];
    const Placing at = posed_placing(part, posed).value_or(in_film);
    const bool scenery = moving_ && part.motion.count == 1 && at == in_film;
    if (selected) color = bright(color);
    if (scenery && !selected) color = dim(color);
    Stroke stroke = as == As::stick && !scenery ? sticks : thin;
    if (selected) stroke = {stroke.line + pen, stroke.dot + pen};
    if (part.bones.empty())
      drawing.draw(wireframe_.lines[part.lines], at, color, stroke);
    else
      drawing.draw(bent(wireframe_.lines[part.lines], skin_of(part, frame, posed)), kWorld, color, stroke);
  }
  if (ground) draw_axes(drawing, camera, pen);
}

modeler::BentSkin FilmDrawing::skin_of(const Part& part, std::uint32_t frame, const Posed& posed) const {
  if (const auto figure = posed.figures.find(part.joint.actor); figure != posed.figures.end())
    if (const auto& bones = figure->second.bones[part.joint.joint]; !bones.empty()) return {bones, part.blend};
  std::vector<wire::Matrix> bones;
  for (const wire::Track& bone : part.bones)
    bones.push_back(matrix_of(wireframe_.matrices[wireframe_.value_at(bone, frame)]));
  return {std::move(bones), part.blend};
}

// Each axis as a little stick near the lower left corner, before everything else.
void FilmDrawing::draw_axes(Drawing& drawing, const wire::Camera& camera, std::uint32_t pen) const {
  const auto width = static_cast<float>(drawing.image().width), height = static_cast<float>(drawing.image().height);
  wire::Camera still = camera;
  for (auto& row : still.world_to_eye.m) row[3] = 0;
  still.shift_x = still.shift_y = 0;
  const bool parallel = camera.projection == wire::Projection::orthographic;
  const double anywhere = camera.focal * height / 2, near_distance = 4 * camera.near;
  const double scale = parallel ? anywhere : anywhere / near_distance;  // pixels a length there
  const double size = 0.06 * height / scale, margin = 0.09 * height;
  const double distance = parallel ? camera.near + 2 * size : near_distance;
  still.world_to_eye.m[0][3] = (margin - width / 2) / scale;
  still.world_to_eye.m[1][3] = (margin - height / 2) / scale;
  still.world_to_eye.m[2][3] = -distance;
  drawing.look(still);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Lines stick{{0, 0, 0, 0, 0, 0}, {0, 1}, 0};
    stick.points[3 + axis] = static_cast<float>(size);
    Color color{0.35f, 0.35f, 0.35f};
    color[axis] = 1;
    drawing.draw(stick, kWorld, color, {pen, 1});
  }
}

images::Image halved(const images::Image& image) {
  images::Image half{image.width / 2, image.height / 2, {}};
  half.pixels.reserve(std::size_t{half.width} * half.height);
  for (std::size_t y = 0; y < half.height; ++y) {
    const std::uint32_t* top = &image.pixels[2 * y * image.width];
    const std::uint32_t* below = top + image.width;
    for (std::size_t x = 0; x < 2 * std::size_t{half.width}; x += 2) {
      std::uint32_t pixel = 0;
      for (const int shift : {0, 8, 16}) {
        const auto part = [&](std::uint32_t p) { return p >> shift & 0xff; };
        pixel |= (part(top[x]) + part(top[x + 1]) + part(below[x]) + part(below[x + 1]) + 2) / 4 << shift;
      }
      half.pixels.push_back(pixel);
    }
  }
  return half;
}

}  // namespace mars::preview
