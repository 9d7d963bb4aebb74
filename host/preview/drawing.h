// Lines into a picture: projected as the renderer projects (node/geometry/scene.cpp), clipped at the near plane and at
// the picture's edges, one pen wide, nearer ones over farther ones, farther ones dimmer. One core, no allocation in
// steady state.
#pragma once

#include <cstdint>
#include <vector>

#include "host/images/png_file.h"
#include "host/preview/wireframe.h"

namespace mars::preview {

struct Stroke {
  std::uint32_t line = 1;  // pixels wide
  std::uint32_t dot = 1;
};

class Drawing {
 public:
  Drawing(std::uint32_t width, std::uint32_t height);

  // An empty picture, seen by `camera`; lines are full bright at `nearest` and dim at `farthest` (distances along
  // its axis).
  void begin(const wire::Camera& camera, const Color& background, double nearest, double farthest);
  // What follows is seen by another camera.
  void look(const wire::Camera& camera);
  // Lines drawn from now on are hidden behind these triangles, which themselves are not seen; lines as near as
  // `behind`, a length along the camera's axis, are not.
  void cover(const Facets& facets, const Placing& to_world, double behind);
  void draw(const Lines& lines, const Placing& to_world, const Color& color, const Stroke& stroke = {});

  const images::Image& image() const { return image_; }

 private:
  // On the screen, pixels from the top left corner; `closeness` is 1 / distance along the camera's axis, or, if
  // orthographic, -distance; kUnseen: nearer than its near plane.
  struct Spot {
    float x, y, closeness;
  };
  static constexpr float kUnseen = -3.4e38f;
  // Before the division: x' = x / w + center, or, if orthographic, x + center.
  struct Place {
    float x, y, w;
  };

  void place(const Placing& to_world);
  Place place_of(const float* point) const;
  Spot project(const Place& place) const;
  void join(const float* from, const float* to, const Color& color);
  void draw_line(Spot from, Spot to, std::uint32_t color);
  void draw_dot(const Spot& spot, std::uint32_t color);
  void cover(const Place& a, const Place& b, const Place& c);
  void cover(Spot a, Spot b, Spot c);
  void plot(std::uint32_t x, std::uint32_t y, float closeness, std::uint32_t color);
  float distance_of(float closeness) const { return parallel_ ? -closeness : 1 / closeness; }
  std::uint32_t dimmed(std::uint32_t color, float closeness) const;

  images::Image image_;
  Stroke stroke_;
  std::vector<float> closest_;  // of each pixel; kUnseen: nothing there
  std::vector<Spot> spots_;
  std::vector<Place> places_;
  Placing to_screen_{};  // of the lines being drawn: x, y before the division and w
  wire::Camera camera_{};
  bool parallel_ = false;
  float center_[2] = {};
  float near_ = 0;
  float nearest_ = 0, fade_ = 0;
  std::uint32_t background_ = 0;
};

}  // namespace mars::preview
