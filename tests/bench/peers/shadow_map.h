// peer-llvmpipe's map of depths: how far from the light the nearest surfaces are, in a window round the whole scene. It
// has the triangles that face the light, moved away from it by glPolygonOffset, so that they do not shade themselves.
#pragma once

#include <string>
#include <vector>

#include "tests/bench/peers/cover.h"
#include "tests/bench/peers/gl_parts.h"
#include "tests/bench/peers/light.h"
#include "tests/bench/peers/mesh.h"

namespace mars::bench {

// Draws triangles of what moves, or of what stands, with the motion's uniform of a program.
class Geometry {
 public:
  virtual ~Geometry() = default;
  virtual void draw_depths(bool moving, GLint motion_at, const Motion& motion) const = 0;
};

class ShadowMap {
 public:
  ShadowMap(const Mesh& mesh, const Geometry& geometry);

  // MAP_X, MAP_Y and MAP_Z, by which shaders find a point in the map; TEXEL: a texel's size.
  std::string numbers() const;

  void draw(const Motion& mover);
  // What stands, once; then what moves over it.
  void keep_standing();
  void draw_changes(const Motion& mover);

 private:
  void begin(GLuint framebuffer) const;
  void end() const;
  Box box_of(const Motion& mover) const;

  const Geometry& geometry_;
  std::vector<Outline> mover_;
  LightAxes axes_;
  LightBox window_;
  GLuint program_ = 0, drawn_ = 0, kept_ = 0;
  GLint motion_at_ = -1;
  Box before_{};  // where the map differs from what stands
};

}  // namespace mars::bench
