// A light that casts sees the scene as a camera does, from one point of it at a time: a view, with a grid that depends
// on light, camera and picture size alone. Points and casters are snapped to the grid, so that whether a caster covers
// a point is decided in whole numbers.
//
// A view maps a place p of eye space to x, y (grid steps) and z, which grows towards the light:
//   of a directional light  x = u.p / step, y = v.p / step, z = axis.p
//   of others, with q = p - place and depth = axis.q  x = u.q / (depth step), y = v.q / (depth step), z = 1 / depth.
// Lights with a place have six such views, one along each axis of eye space; a spot whose cone has at most 90 degrees
// has one. What is plane in space is plane over the grid too.
//
// Rounding. A point lies off its surface by at most 1/256 of a pixel there, for triangles are snapped on the screen;
// off its place on the grid by a step; float arithmetic moves it by its distance times 2^-20 at most; and its depth 1 /
// w comes from a triangle's plane, which is off by some 2^-23 of the greatest depth there is, 1 / near. Let e be the
// sum of the four lengths. A surface through the true point is then nearer to the light than the point by at most e (1
// + s), s the surface's slope towards the view: what is not nearer by more does not block it. This includes the point's
// own triangle and those that meet it. In parallel projection a pixel is as large everywhere, and a depth is off by
// some 2^-23 of the farthest there is.
#pragma once

#include <cstdint>

namespace mars::shadow {

struct LightView {
  float u[3], v[3];
  float axis[3];  // to a directional light; away from others
  float place[3];
  float per_step;
  float nearest;  // depth of what lights with a place shine at, at least; nearer to them nothing casts or is shaded
  std::uint32_t has_place;
  std::uint32_t is_face;  // of six: only points within 45 degrees of its axis are its own
};

// What points need of a picture, where they are counted from `origin`: e of a point at distance w along the view axis
// is (w by_square + by_w) w + everywhere, and of lights with a place depth * by_depth more.
struct PointFrame {
  float scale;  // as in shape::Projection
  float squeeze;
  float center[2];
  float origin[2];
  float nothing;
  bool parallel;
  float by_w;
  float by_square;
  float everywhere;
  float by_depth;
};

}  // namespace mars::shadow
