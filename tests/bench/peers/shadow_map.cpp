#include "tests/bench/peers/shadow_map.h"

#include <algorithm>

#include "tests/bench/peers/gl_shaders.h"

namespace mars::bench {
namespace {

constexpr GLsizei kSide = 4096;             // texels
constexpr float kMargin = 0.002f;           // of the window's size, beyond the scene
constexpr float kSlope = 3, kUnits = 1024;  // of glPolygonOffset

// Around the whole scene at all times.
LightBox window_of(const Mesh& mesh, const LightAxes& axes, const std::vector<Outline>& mover) {
  std::vector<LightBox> boxes;
  for (const Outline& outline : outlines_of(mesh, false)) boxes.push_back(light_box(axes, outline, kStill));
  for (const Motion& motion : mesh.motion)
    for (const Outline& outline : mover) boxes.push_back(light_box(axes, outline, motion));
  LightBox window = boxes[0];
  for (const LightBox& box : boxes) window = round(window, box);
  for (std::size_t k = 0; k < 3; ++k) {
    const float margin = kMargin * (window.high[k] - window.low[k]);
    window.low[k] -= margin, window.high[k] += margin;
  }
  return window;
}

GLuint map_framebuffer(bool sampled) {
  GLuint names[2];
  glGenFramebuffers(1, &names[0]);
  glBindFramebuffer(GL_FRAMEBUFFER, names[0]);
  glActiveTexture(GL_TEXTURE0 + (sampled ? 0 : 3));
  glGenTextures(1, &names[1]);
  glBindTexture(GL_TEXTURE_2D, names[1]);
  glTexStorage2D(GL_TEXTURE_2D, 1, GL_DEPTH_COMPONENT32F, kSide, kSide);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, names[1], 0);
  glDrawBuffer(GL_NONE);
  glReadBuffer(GL_NONE);
  check_framebuffer();
  return names[0];
}

std::vector<Outline> all_outlines(const Mesh& mesh) {
  std::vector<Outline> outlines = outlines_of(mesh, false);
  for (const Outline& outline : outlines_of(mesh, true)) outlines.push_back(outline);
  return outlines;
}

}  // namespace

ShadowMap::ShadowMap(const Mesh& mesh, const Geometry& geometry)
    : geometry_(geometry),
      mover_(outlines_of(mesh, true)),
      axes_(light_axes(mesh.head, all_outlines(mesh))),
      window_(window_of(mesh, axes_, mover_)),
      drawn_(map_framebuffer(true)),
      kept_(mover_.empty() ? 0 : map_framebuffer(false)) {
  const Shaders shaders = map_shaders(numbers());
  program_ = link_program(shaders.vertex, shaders.fragment);
  motion_at_ = glGetUniformLocation(program_, "motion");
}

std::string ShadowMap::numbers() const {
  const auto row = [&](const char* name, std::size_t k, bool backwards) {
    const float size = window_.high[k] - window_.low[k], scale = backwards ? -1 / size : 1 / size;
    const std::array<float, 3>& axis = axes_.axis[k];
    return defined(name, "vec4", scale * axis[0], scale * axis[1], scale * axis[2],
                   (backwards ? window_.high[k] : -window_.low[k]) / size);
  };
  return row("MAP_X", 0, false) + row("MAP_Y", 1, false) + row("MAP_Z", 2, true) +
         defined("TEXEL", "float", 1.0f / kSide);
}

void ShadowMap::begin(GLuint framebuffer) const {
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
  glUseProgram(program_);
  glViewport(0, 0, kSide, kSide);
  glCullFace(GL_FRONT);  // which are behind, as the light sees them: the map is not upside down
  glEnable(GL_POLYGON_OFFSET_FILL);
  glPolygonOffset(kSlope, kUnits);
}

void ShadowMap::end() const {
  glCullFace(GL_BACK);
  glDisable(GL_POLYGON_OFFSET_FILL);
}

void ShadowMap::draw(const Motion& mover) {
  begin(drawn_);
  glClear(GL_DEPTH_BUFFER_BIT);
  geometry_.draw_depths(true, motion_at_, mover);
  geometry_.draw_depths(false, motion_at_, kStill);
  end();
}

void ShadowMap::keep_standing() {
  begin(kept_);
  glClear(GL_DEPTH_BUFFER_BIT);
  geometry_.draw_depths(false, motion_at_, kStill);
  end();
  copy({0, 0, kSide, kSide}, kept_, drawn_, GL_DEPTH_BUFFER_BIT);
  before_ = {};
}

void ShadowMap::draw_changes(const Motion& mover) {
  const Box now = box_of(mover);
  copy(round(before_, now), kept_, drawn_, GL_DEPTH_BUFFER_BIT);
  before_ = now;
  begin(drawn_);
  geometry_.draw_depths(true, motion_at_, mover);
  end();
}

Box ShadowMap::box_of(const Motion& mover) const {
  LightBox box = light_box(axes_, mover_[0], mover);
  for (const Outline& outline : mover_) box = round(box, light_box(axes_, outline, mover));
  int low[2], high[2];
  for (std::size_t k = 0; k < 2; ++k) {
    const float texels = kSide / (window_.high[k] - window_.low[k]);
    low[k] = std::clamp(static_cast<int>((box.low[k] - window_.low[k]) * texels) - 1, 0, kSide);
    high[k] = std::clamp(static_cast<int>((box.high[k] - window_.low[k]) * texels) + 2, 0, kSide);
  }
  return {low[0], low[1], high[0] - low[0], high[1] - low[1]};
}

}  // namespace mars::bench
