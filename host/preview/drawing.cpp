#include "host/preview/drawing.h"

#include <algorithm>
#include <cmath>

namespace mars::preview {
namespace {

constexpr float kDimmest = 0.28f;  // of a colour at the far end
constexpr int kFixed = 16;         // bits behind the point of a line's slope

// Cuts from..to to 0 <= f(point) along one edge of the picture; false if nothing is left.
template <typename Spot>
bool cut(Spot& from, Spot& to, float at_from, float at_to) {
  if (at_from < 0 && at_to < 0) return false;
  if (at_from >= 0 && at_to >= 0) return true;
  const float part = at_from / (at_from - at_to);
  const Spot at{from.x + part * (to.x - from.x), from.y + part * (to.y - from.y),
                from.closeness + part * (to.closeness - from.closeness)};
  (at_from < 0 ? from : to) = at;
  return true;
}

std::uint32_t pixel_of_color(const Color& color) {
  std::uint32_t pixel = 0;
  for (int i = 2; i >= 0; --i)
    pixel = pixel << 8 |
            static_cast<std::uint32_t>(std::clamp(color[static_cast<std::size_t>(i)], 0.0f, 1.0f) * 255 + 0.5f);
  return pixel;
}

}  // namespace

Drawing::Drawing(std::uint32_t width, std::uint32_t height)
    : image_{width, height, std::vector<std::uint32_t>(std::size_t{width} * height)}, closest_(image_.pixels.size()) {}

void Drawing::begin(const wire::Camera& camera, const Color& background, double nearest, double farthest) {
  look(camera);
  nearest_ = static_cast<float>(std::max(nearest, camera.near));
  fade_ = (1 - kDimmest) / std::max(static_cast<float>(farthest) - nearest_, 1e-6f);
  background_ = pixel_of_color(background);
  std::fill(image_.pixels.begin(), image_.pixels.end(), background_);
  std::fill(closest_.begin(), closest_.end(), kUnseen);
}

void Drawing::look(const wire::Camera& camera) {
  camera_ = camera;
  near_ = static_cast<float>(camera.near);
  parallel_ = camera.projection == wire::Projection::orthographic;
  center_[0] = static_cast<float>((0.5 - camera.shift_x) * image_.width);
  center_[1] = static_cast<float>((0.5 + camera.shift_y) * image_.height);
}

void Drawing::place(const Placing& to_world) {
  const double scale = camera_.focal * image_.height / 2;
  for (std::size_t row = 0; row < 3; ++row) {
    const auto& eye = camera_.world_to_eye.m[row];
    const double by = row == 2 ? -1 : row == 1 ? -scale : scale;  // y down, w ahead
    for (std::size_t column = 0; column < 4; ++column) {
      double sum = column == 3 ? eye[3] : 0;
      for (std::size_t i = 0; i < 3; ++i) sum += eye[i] * to_world[4 * i + column];
      to_screen_[4 * row + column] = static_cast<float>(by * sum);
    }
  }
}

void Drawing::cover(const Facets& facets, const Placing& to_world, double behind) {
  place(to_world);
  to_screen_[11] += static_cast<float>(behind);
  const std::size_t points = facets.points.size() / 3;
  places_.resize(std::max(places_.size(), points));
  for (std::size_t i = 0; i < points; ++i) places_[i] = place_of(&facets.points[3 * i]);
  for (std::size_t i = 0; i + 2 < facets.corners.size(); i += 3)
    cover(places_[facets.corners[i]], places_[facets.corners[i + 1]], places_[facets.corners[i + 2]]);
}

// Cut at the near plane, which leaves up to four corners.
void Drawing::cover(const Place& a, const Place& b, const Place& c) {
  const Place* const corners[] = {&a, &b, &c};
  Spot spots[4];
  std::size_t count = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Place &from = *corners[i], &to = *corners[(i + 1) % 3];
    if (from.w >= near_) spots[count++] = project(from);
    if ((from.w >= near_) == (to.w >= near_)) continue;
    const float part = (near_ - from.w) / (to.w - from.w);
    spots[count++] = project({from.x + part * (to.x - from.x), from.y + part * (to.y - from.y), near_});
  }
  for (std::size_t i = 2; i < count; ++i) cover(spots[0], spots[i - 1], spots[i]);
}

// At the middle of each pixel.
void Drawing::cover(Spot a, Spot b, Spot c) {
  if (a.y > b.y) std::swap(a, b);
  if (b.y > c.y) std::swap(b, c);
  if (a.y > b.y) std::swap(a, b);
  const auto height = static_cast<float>(image_.height), width = static_cast<float>(image_.width);
  const float first = std::ceil(std::max(a.y, 0.0f) - 0.5f), last = std::min(c.y, height) - 0.5f;
  const auto at = [](const Spot& from, const Spot& to, float y) {
    const float part = to.y > from.y ? (y - from.y) / (to.y - from.y) : 0;
    return Spot{from.x + part * (to.x - from.x), y, from.closeness + part * (to.closeness - from.closeness)};
  };
  for (float row = std::max(first, 0.0f); row <= last; ++row) {
    const float y = row + 0.5f;
    Spot left = at(a, c, y), right = y < b.y ? at(a, b, y) : at(b, c, y);
    if (left.x > right.x) std::swap(left, right);
    const float slope = right.x > left.x ? (right.closeness - left.closeness) / (right.x - left.x) : 0;
    const float from = std::max(std::ceil(left.x - 0.5f), 0.0f), to = std::min(right.x, width) - 0.5f;
    float* const closest = &closest_[static_cast<std::size_t>(row) * image_.width];
    for (float column = from; column <= to; ++column) {
      float& nearest = closest[static_cast<std::size_t>(column)];
      nearest = std::max(nearest, left.closeness + (column + 0.5f - left.x) * slope);
    }
  }
}

void Drawing::draw(const Lines& lines, const Placing& to_world, const Color& color, const Stroke& stroke) {
  stroke_ = stroke;
  place(to_world);
  const std::size_t points = lines.points.size() / 3;
  spots_.resize(std::max(spots_.size(), points));
  for (std::size_t i = 0; i < points; ++i) spots_[i] = project(place_of(&lines.points[3 * i]));
  const std::uint32_t pixel = pixel_of_color(color);
  for (std::size_t i = 0; i + 1 < lines.ends.size(); i += 2) {
    const Spot &from = spots_[lines.ends[i]], &to = spots_[lines.ends[i + 1]];
    const bool from_is_seen = from.closeness > kUnseen, to_is_seen = to.closeness > kUnseen;
    if (from_is_seen && to_is_seen)
      draw_line(from, to, pixel);
    else if (from_is_seen || to_is_seen)
      join(&lines.points[3 * lines.ends[i]], &lines.points[3 * lines.ends[i + 1]], color);
  }
  for (std::size_t i = 0; i < lines.dots; ++i) draw_dot(spots_[i], pixel);
}

Drawing::Place Drawing::place_of(const float* point) const {
  const auto row = [&](std::size_t r) {
    const float* m = &to_screen_[4 * r];
    return m[0] * point[0] + m[1] * point[1] + m[2] * point[2] + m[3];
  };
  return {row(0), row(1), row(2)};
}

Drawing::Spot Drawing::project(const Place& place) const {
  if (!(place.w >= near_)) return {0, 0, kUnseen};
  if (parallel_) return {place.x + center_[0], place.y + center_[1], -place.w};
  const float closeness = 1 / place.w;
  return {place.x * closeness + center_[0], place.y * closeness + center_[1], closeness};
}

// A line with one end before the near plane: the other end is put there.
void Drawing::join(const float* from, const float* to, const Color& color) {
  Place a = place_of(from), b = place_of(to);
  if (a.w < b.w) std::swap(a, b);
  const float part = (a.w - near_) / (a.w - b.w);
  const Place at{a.x + part * (b.x - a.x), a.y + part * (b.y - a.y), near_};
  draw_line(project(a), project(at), pixel_of_color(color));
}

// One pixel a column of flat lines, a row of steep ones: the one whose middle the line passes next to.
void Drawing::draw_line(Spot from, Spot to, std::uint32_t color) {
  const auto width = static_cast<float>(image_.width), height = static_cast<float>(image_.height);
  if (!cut(from, to, from.x, to.x) || !cut(from, to, width - from.x, width - to.x) || !cut(from, to, from.y, to.y) ||
      !cut(from, to, height - from.y, height - to.y))
    return;
  color = dimmed(color, 0.5f * (from.closeness + to.closeness));
  const bool flat = std::abs(to.x - from.x) >= std::abs(to.y - from.y);
  if (flat ? from.x > to.x : from.y > to.y) std::swap(from, to);
  const float a = flat ? from.x : from.y, b = flat ? to.x : to.y;  // along the line
  const float c = flat ? from.y : from.x, d = flat ? to.y : to.x;  // across
  const auto along_size = static_cast<std::int32_t>(flat ? image_.width : image_.height);
  const auto across_size = static_cast<std::int32_t>(flat ? image_.height : image_.width);
  const std::int32_t first = std::clamp(static_cast<std::int32_t>(a), 0, along_size - 1);
  const std::int32_t last = std::clamp(static_cast<std::int32_t>(b), first, along_size - 1);
  const float length = std::max(b - a, 1e-3f), slope = (d - c) / length;
  const float closer = (to.closeness - from.closeness) / length;
  const float to_middle = static_cast<float>(first) + 0.5f - a;
  const auto fixed = [&](float at) {
    const float most = static_cast<float>(across_size) - 1.0f / 256;
    return static_cast<std::int32_t>(std::clamp(at, 0.0f, most) * (1 << kFixed));
  };
  const std::int32_t steps = last - first;
  std::int32_t at = fixed(c + to_middle * slope);
  const std::int32_t end = fixed(c + (to_middle + static_cast<float>(steps)) * slope);
  const std::int32_t step = steps > 0 ? (end - at) / steps : 0;
  float closeness = from.closeness + to_middle * closer;
  const std::size_t along_stride = flat ? 1 : image_.width, across_stride = flat ? image_.width : 1;
  for (std::int32_t i = first; i <= last; ++i, at += step, closeness += closer) {
    const std::int32_t across = at >> kFixed;
    std::size_t index = static_cast<std::size_t>(i) * along_stride + static_cast<std::size_t>(across) * across_stride;
    const std::int32_t pens = std::min(static_cast<std::int32_t>(stroke_.line), across_size - across);
    for (std::int32_t pen = 0; pen < pens; ++pen, index += across_stride)
      if (closeness > closest_[index]) {
        closest_[index] = closeness;
        image_.pixels[index] = color;
      }
  }
}

void Drawing::draw_dot(const Spot& spot, std::uint32_t color) {
  if (spot.closeness <= kUnseen || !(spot.x >= 0 && spot.x < static_cast<float>(image_.width)) ||
      !(spot.y >= 0 && spot.y < static_cast<float>(image_.height)))
    return;
  color = dimmed(color, spot.closeness);
  color += (0xffffffu - color) >> 1 & 0x7f7f7fu;                               // half way to white
  const float closeness = spot.closeness + 0.001f * std::abs(spot.closeness);  // over its own lines
  const std::uint32_t before = (stroke_.dot - 1) / 2;
  const auto from = [&](float middle) {
    const auto at = static_cast<std::uint32_t>(middle);
    return at - std::min(at, before);
  };
  const std::uint32_t left = from(spot.x), top = from(spot.y);
  for (std::uint32_t y = top; y < std::min(top + stroke_.dot, image_.height); ++y)
    for (std::uint32_t x = left; x < std::min(left + stroke_.dot, image_.width); ++x) plot(x, y, closeness, color);
}

void Drawing::plot(std::uint32_t x, std::uint32_t y, float closeness, std::uint32_t color) {
  const std::size_t index = std::size_t{y} * image_.width + x;
  if (closeness <= closest_[index]) return;
  closest_[index] = closeness;
  image_.pixels[index] = color;
}

std::uint32_t Drawing::dimmed(std::uint32_t color, float closeness) const {
  const float bright = 1 - (distance_of(closeness) - nearest_) * fade_;
  const auto part = static_cast<std::uint32_t>(std::clamp(bright, kDimmest, 1.0f) * 256);
  const auto mixed = [&](std::uint32_t mask) {
    return ((color & mask) * part + (background_ & mask) * (256 - part)) >> 8 & mask;
  };
  return mixed(0xff00ff) | mixed(0x00ff00);
}

}  // namespace mars::preview
