// What Embree's rays meet: the standing part of a mesh, or what moves. A view is a tree with its triangles' normals,
// and the eye and the light as that tree has them: rays are turned instead of the tree. Every view's z is its rays'
// parameter, so views can be compared.
#pragma once

#include <embree3/rtcore.h>

#include <cstdint>
#include <vector>

#include "tests/bench/peers/cover.h"
#include "tests/bench/peers/embree_packet.h"
#include "tests/bench/peers/mesh.h"

namespace mars::bench {

// A triangle's normals: the first corner's, and the differences of the others to it.
struct alignas(16) Normals {
  float first[3], to_second[3], to_third[3];
  std::uint32_t look;
};

struct View {
  RTCScene scene;
  std::vector<Normals> normals;
  std::vector<Outline> outlines;    // of its patches
  std::vector<std::uint8_t> tiles;  // 1: a ray there may meet it
  float origin[3];
  float ahead[3], right[3], up[3];  // a ray's direction: ahead + x * right + y * up, of length 1 along the eye's axis
  float to_light[3], across_light[2][3];  // the latter: unit, across the light's rays

  bool empty() const { return normals.empty(); }
};

// Of what moves, in its place at frame 0, or of what stands.
View view_of(const Mesh& mesh, bool moving, RTCDevice device);

// Turns the eye and the light against `motion`, so that the tree need not be.
void set_motion(View& view, const MeshHead& head, const Motion& motion);

// Rays of one packet, in the view's space.
struct Directions {
  Floats axis[3];
};

// Through the points (x, y) of the plane at distance 1 before the eye.
Directions directions_of(const View& view, Floats x, Floats y);

// Traces the rays of `inside` as far as `limit`; returns those that met a front face, which `rays` then describes.
Ints trace(const View& view, const Directions& directions, Ints inside, Floats limit, RTCRayHit16& rays);

// Points of triangles, one in each place of a packet.
struct Points {
  Ints triangles;
  Floats u, v;
  Directions directions;  // to them
};

// Red, green and blue, 0..1.
struct Levels {
  Floats level[3];
};

// A point's levels where nothing of the light arrives, and what all of it adds.
struct Lit {
  Levels base, term;
};

// Of the points of `met`.
Lit shade(const View& view, const Mesh& mesh, const Points& points, Ints met);

// 1 at most, where `share` of the light arrives.
Levels levels_of(const Lit& lit, Floats share);

// Of triangles that rays met: those whose face is towards the light.
Ints facing_light(const View& view, const RTCRayHit16& rays);

}  // namespace mars::bench
