// Mesa's llvmpipe as a competitor: peer-llvmpipe MESH THREADS whole|inbetween SAMPLES SHADOWS, or peer-llvmpipe MESH
// THREADS film SAMPLES SHADOWS FOLDER ENCODER, or peer-llvmpipe encoders, which names these. How it was made fast:
// README.md.
//
// The scene is in buffers once; a frame is a few draw calls and glReadPixels. Inbetweens begin from the standing
// part's colours and depths, which another framebuffer keeps. Several samples a pixel are drawn and kept in
// multisampled framebuffers, and resolved before they are read. Of a film, the standing part is drawn for the first
// frame, and each frame is written to a file while the next ones are drawn. Shadows come from a map of depths
// (shadow_map.h): "map" is drawn in every whole frame, "kept-map" once. In inbetweens, what stands is shaded again from
// stored light where a shadow of what moves may fall.
#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>
#include <map>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <tuple>

#include "tests/bench/peers/cover.h"
#include "tests/bench/peers/frame_files.h"
#include "tests/bench/peers/gl_parts.h"
#include "tests/bench/peers/gl_shaders.h"
#include "tests/bench/peers/mesh.h"
#include "tests/bench/peers/peer.h"
#include "tests/bench/peers/shadow_map.h"

namespace mars::bench {
namespace {

struct Corner {
  std::array<float, 3> place, normal;
};

// Indices [first, first + count) of one colour.
struct Batch {
  std::size_t first, count;
  std::uint32_t look;
};

// Segments in the order of their distance, nearest first, and so the patches of each, so that what is hidden is not
// shaded.
std::vector<const MeshPatch*> by_distance(const Mesh& mesh, bool moving) {
  std::vector<const MeshPatch*> patches;
  std::map<std::uint32_t, float> of_segment;
  std::map<const MeshPatch*, float> of_patch;
  for (const MeshPatch& patch : mesh.patches) {
    if ((patch.moves == 1) != moving) continue;
    float sum = 0;
    for (std::uint32_t k = 0; k < patch.vertices; ++k) sum -= mesh.vertices[patch.first_vertex + k].place[2];
    patches.push_back(&patch);
    of_patch[&patch] = sum / static_cast<float>(patch.vertices);
    of_segment[patch.segment] += of_patch[&patch];  // all have as many patches
  }
  std::sort(patches.begin(), patches.end(), [&](auto* a, auto* b) {
    return std::tuple(of_segment[a->segment], a->segment, of_patch[a]) <
           std::tuple(of_segment[b->segment], b->segment, of_patch[b]);
  });
  return patches;
}

enum class Course { whole, inbetween, film };
enum class Shadows { none, map, kept_map };

// Where pictures differ from what stands.
struct Changes {
  Box mover, shadow;
};

Changes round(const Changes& a, const Changes& b) { return {round(a.mover, b.mover), round(a.shadow, b.shadow)}; }

struct Program {
  GLuint name;
  GLint motion_at, own_at;
};

Program link(const Shaders& shaders) {
  const GLuint name = link_program(shaders.vertex, shaders.fragment);
  return {name, glGetUniformLocation(name, "motion"), glGetUniformLocation(name, "own")};
}

class Renderer : public Geometry {
 public:
  // `files`: of a film's frames; none in other courses.
  Renderer(const Mesh& mesh, Course course, int samples, Shadows shadows, FrameFiles* files);

  void render();
  Cost measure_map();
  Picture picture() const { return {mesh_.head.width, mesh_.head.height, *shown_}; }
  void draw_depths(bool moving, GLint motion_at, const Motion& motion) const override;

 private:
  void load();
  void begin_shadows(GLsizei samples);
  void target(GLuint framebuffer) const;
  void draw(const Program& program, bool moving, const Motion& motion) const;
  void render_whole();
  void keep_standing();
  void restore(const Changes& where) const;
  Changes draw_changes();
  void draw_shadow(const Box& box) const;
  void render_inbetween();
  void render_of_film();
  Box mover_box(const Motion& motion) const;
  Box shaded_box(const Motion& motion) const;
  Box whole() const { return {0, 0, width_, height_}; }
  void read(const Box& box, std::vector<std::uint32_t>& pixels) const;
  void read(const Changes& where, std::vector<std::uint32_t>& pixels) const;

  const Mesh& mesh_;
  Course course_;
  Shadows shadows_;
  FrameFiles* files_;
  GLsizei width_, height_;
  Program surface_{}, kept_surface_{}, shadow_{};
  GLuint drawn_ = 0, kept_ = 0, resolved_ = 0;  // the last only where there are several samples
  std::vector<Batch> batches_[2];               // what stands, what moves
  std::optional<ShadowMap> map_;
  std::optional<ShadedAreas> shaded_areas_;
  std::uint32_t number_;  // of the last frame rendered; inbetweens are all but 0
  std::vector<Outline> mover_;
  Changes before_{};                 // where what was drawn differs from what stands
  std::vector<Changes> in_buffers_;  // the same of each of the files' buffers
  std::vector<std::uint32_t> pixels_;
  const std::vector<std::uint32_t>* shown_ = &pixels_;
};

Renderer::Renderer(const Mesh& mesh, Course course, int samples, Shadows shadows, FrameFiles* files)
    : mesh_(mesh),
      course_(course),
      shadows_(shadows),
      files_(files),
      width_(static_cast<GLsizei>(mesh.head.width)),
      height_(static_cast<GLsizei>(mesh.head.height)),
      number_(mesh.head.frames - 1),
      mover_(outlines_of(mesh, true)),
      pixels_(mesh.head.width * std::size_t{mesh.head.height}) {
  const MeshHead& head = mesh.head;
  load();
  glEnable(GL_DEPTH_TEST);
  glEnable(GL_CULL_FACE);
  glFrontFace(GL_CW);
  glClearColor(head.background[0], head.background[1], head.background[2], 1);
  glPixelStorei(GL_PACK_ROW_LENGTH, width_);
  if (shadows_ != Shadows::none) map_.emplace(mesh, *this);
  surface_ = link(surface_shaders(head, map_ ? map_->numbers() : ""));
  if (samples > 1) resolved_ = framebuffer(width_, height_, 0);
  kept_ = framebuffer(width_, height_, samples > 1 ? samples : 0);
  if (map_ && course_ != Course::whole) begin_shadows(samples > 1 ? samples : 0);
  drawn_ = framebuffer(width_, height_, samples > 1 ? samples : 0);
  if (shadows_ == Shadows::kept_map) map_->draw(kStill);
  if (course_ != Course::inbetween) return;
  keep_standing();
  copy(whole(), kept_, drawn_, GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  read(whole(), pixels_);
}

// What shadows of what moves need: kept_, which is bound, gets two more colours.
void Renderer::begin_shadows(GLsizei samples) {
  const std::string map = map_->numbers();
  kept_surface_ = link(kept_surface_shaders(mesh_.head, map));
  shadow_ = link(shadow_shaders(mesh_.head, map, samples));
  shaded_areas_.emplace(mesh_, 0.0f);
  const GLenum formats[2] = {GL_RGBA32F, GL_RGBA16F};
  const char* names[2] = {"bases", "terms"};
  glUseProgram(shadow_.name);
  for (GLuint k = 0; k < 2; ++k) {
    glActiveTexture(GL_TEXTURE1 + k);
    add_texture(1 + k, formats[k], width_, height_, samples);
    glUniform1i(glGetUniformLocation(shadow_.name, names[k]), static_cast<GLint>(1 + k));
  }
  const GLenum buffers[3] = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1, GL_COLOR_ATTACHMENT2};
  glDrawBuffers(3, buffers);
  check_framebuffer();
}

void Renderer::load() {
  std::vector<Corner> corners;
  corners.reserve(mesh_.vertices.size());
  std::vector<std::uint32_t> indices;
  indices.reserve(3 * mesh_.triangles.size());
  for (const bool moving : {false, true})
    for (const MeshPatch* patch : by_distance(mesh_, moving)) {
      const auto at = static_cast<std::uint32_t>(corners.size()) - patch->first_vertex;
      std::vector<Batch>& batches = batches_[moving];
      if (batches.empty() || batches.back().look != patch->look) batches.push_back({indices.size(), 0, patch->look});
      for (std::uint32_t k = patch->first_vertex; k < patch->first_vertex + patch->vertices; ++k)
        corners.push_back({mesh_.vertices[k].place, mesh_.vertices[k].normal});
      for (std::uint32_t t = patch->first_triangle; t < patch->first_triangle + patch->triangles; ++t)
        for (const std::uint32_t corner : mesh_.triangles[t]) indices.push_back(at + corner);
      batches.back().count = indices.size() - batches.back().first;
    }
  GLuint names[3];
  glGenVertexArrays(1, &names[2]);
  glBindVertexArray(names[2]);
  glGenBuffers(2, names);
  glBindBuffer(GL_ARRAY_BUFFER, names[0]);
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(corners.size() * sizeof(Corner)), corners.data(),
               GL_STATIC_DRAW);
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, names[1]);
  glBufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(indices.size() * sizeof(std::uint32_t)), indices.data(),
               GL_STATIC_DRAW);
  for (GLuint k = 0; k < 2; ++k) {
    glEnableVertexAttribArray(k);
    glVertexAttribPointer(k, 3, GL_FLOAT, GL_FALSE, sizeof(Corner), reinterpret_cast<void*>(k * 3 * sizeof(float)));
  }
}

void set_motion(GLint motion_at, const Motion& m) {
  const float columns[12] = {m[0][0], m[1][0], m[2][0], m[0][1], m[1][1], m[2][1],
                             m[0][2], m[1][2], m[2][2], m[0][3], m[1][3], m[2][3]};
  glUniformMatrix4x3fv(motion_at, 1, GL_FALSE, columns);
}

void draw_indices(std::size_t first, std::size_t count) {
  glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(count), GL_UNSIGNED_INT,
                 reinterpret_cast<void*>(first * sizeof(std::uint32_t)));
}

void Renderer::target(GLuint framebuffer) const {
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
  glViewport(0, 0, width_, height_);
}

void Renderer::draw(const Program& program, bool moving, const Motion& motion) const {
  glUseProgram(program.name);
  set_motion(program.motion_at, motion);
  for (const Batch& batch : batches_[moving]) {
    glUniform3fv(program.own_at, 1, mesh_.looks[batch.look].data());
    draw_indices(batch.first, batch.count);
  }
}

void Renderer::draw_depths(bool moving, GLint motion_at, const Motion& motion) const {
  if (batches_[moving].empty()) return;
  set_motion(motion_at, motion);
  const Batch &first = batches_[moving].front(), &last = batches_[moving].back();
  draw_indices(first.first, last.first + last.count - first.first);
}

void Renderer::render() {
  number_ = (number_ + 1) % mesh_.head.frames;
  if (course_ == Course::inbetween && number_ == 0) number_ = 1;
  switch (course_) {
    case Course::whole: return render_whole();
    case Course::inbetween: return render_inbetween();
    case Course::film: return render_of_film();
  }
}

// From what was drawn.
void Renderer::read(const Box& box, std::vector<std::uint32_t>& pixels) const {
  if (box.width == 0) return;
  if (resolved_ != 0) copy(box, drawn_, resolved_, GL_COLOR_BUFFER_BIT);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, resolved_ != 0 ? resolved_ : drawn_);
  glReadPixels(box.left, box.top, box.width, box.height, GL_RGBA, GL_UNSIGNED_BYTE,
               &pixels[static_cast<std::size_t>(box.top) * mesh_.head.width + static_cast<std::size_t>(box.left)]);
}

void Renderer::read(const Changes& where, std::vector<std::uint32_t>& pixels) const {
  read(where.mover, pixels);
  read(where.shadow, pixels);
}

void Renderer::render_whole() {
  if (shadows_ == Shadows::map) map_->draw(mesh_.motion[number_]);
  target(drawn_);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  draw(surface_, true, mesh_.motion[number_]);  // it is in front, and hides
  draw(surface_, false, kStill);
  read(whole(), pixels_);
}

void Renderer::keep_standing() {
  if (map_) map_->keep_standing();
  target(kept_);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  constexpr float kNothing[4] = {};
  for (GLint number = 1; map_ && number <= 2; ++number) glClearBufferfv(GL_COLOR, number, kNothing);
  draw(map_ ? kept_surface_ : surface_, false, kStill);
}

// What stands, into what is drawn.
void Renderer::restore(const Changes& where) const {
  copy(where.mover, kept_, drawn_, GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  if (where.shadow.width != 0) copy(where.shadow, kept_, drawn_, GL_COLOR_BUFFER_BIT);
}

// Over what stands; where they are.
Changes Renderer::draw_changes() {
  const Motion& motion = mesh_.motion[number_];
  const Changes now{mover_box(motion), shaded_box(motion)};
  if (map_) map_->draw_changes(motion);
  restore(round(before_, now));
  before_ = now;
  target(drawn_);
  if (now.shadow.width != 0) draw_shadow(now.shadow);
  draw(surface_, true, motion);
  return now;
}

void Renderer::draw_shadow(const Box& box) const {
  glUseProgram(shadow_.name);
  glDisable(GL_DEPTH_TEST);
  glEnable(GL_SCISSOR_TEST);
  glScissor(box.left, box.top, box.width, box.height);
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glDisable(GL_SCISSOR_TEST);
  glEnable(GL_DEPTH_TEST);
}

void Renderer::render_inbetween() {
  const Changes before = before_;
  read(round(before, draw_changes()), pixels_);
}

void Renderer::render_of_film() {
  if (number_ == 0) {
    keep_standing();
    before_ = {whole(), {}};
    in_buffers_.assign(files_->buffers().size(), before_);
  }
  const Changes now = draw_changes();
  const std::size_t at = files_->free_buffer();
  FrameBuffer& buffer = files_->buffers()[at];
  read(round(in_buffers_[at], now), buffer.pixels);
  in_buffers_[at] = now;
  buffer.number = number_;
  shown_ = &buffer.pixels;
  files_->submit(at);
  if (number_ + 1 == mesh_.head.frames) files_->finish();
}

// What a frame needs of the map: all of it, or what moves.
Cost Renderer::measure_map() {
  constexpr int kRounds = 15;
  double least = std::numeric_limits<double>::infinity();
  for (int round = 0; round < kRounds; ++round) {
    glFinish();
    const auto start = std::chrono::steady_clock::now();
    if (course_ == Course::whole)
      map_->draw(mesh_.motion[0]);
    else
      map_->draw_changes(mesh_.motion[1]);
    glFinish();
    least = std::min(least, milliseconds_since(start));
  }
  return {"a shadow map", "ms", least, course_ == Course::whole ? "the whole scene" : "what moves"};
}

Box box_of(const Area& area) { return {area.left, area.top, area.right - area.left, area.bottom - area.top}; }

Box Renderer::mover_box(const Motion& motion) const {
  Box box{};
  for (const Outline& outline : mover_) box = round(box, box_of(cover(outline, mesh_.head, motion)));
  return box;
}

// Where a shadow of what moves may fall.
Box Renderer::shaded_box(const Motion& motion) const {
  Box box{};
  if (!shaded_areas_) return box;
  for (const Area& area : shaded_areas_->of(motion)) box = round(box, box_of(area));
  return box;
}

Course course_of(std::string_view word) {
  if (word == "whole") return Course::whole;
  if (word == "inbetween") return Course::inbetween;
  check(word == "film", "none of whole, inbetween, film: " + std::string(word));
  return Course::film;
}

Shadows shadows_of(std::string_view word) {
  if (word == "none") return Shadows::none;
  if (word == "map") return Shadows::map;
  check(word == "kept-map", "none of none, map, kept-map: " + std::string(word));
  return Shadows::kept_map;
}

void run(int argc, char** argv) {
  if (argc == 2 && argv[1] == std::string_view("encoders")) {
    for (const std::string& name : png_encoders()) std::cout << name << '\n';
    return;
  }
  check(argc >= 6, "usage: peer-llvmpipe MESH THREADS whole|inbetween|film SAMPLES SHADOWS [FOLDER ENCODER]");
  const Course course = course_of(argv[3]);
  check(argc == (course == Course::film ? 8 : 6), "a film has a folder and an encoder, other courses have none");
  begin_gl(argv[2]);
  const Mesh mesh = read_mesh(argv[1]);
  const int samples = std::stoi(argv[4]);
  GLint most = 0;
  glGetIntegerv(GL_MAX_SAMPLES, &most);
  check(samples == 1 || samples <= most, "llvmpipe has " + std::to_string(most) + " samples a pixel at most");
  std::optional<FrameFiles> files;
  if (course == Course::film) files.emplace(argv[6], argv[7], mesh.head.width, mesh.head.height);
  Renderer renderer(mesh, course, samples, shadows_of(argv[5]), files ? &*files : nullptr);
  const std::string driver = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  const std::string version = reinterpret_cast<const char*>(glGetString(GL_VERSION));
  obey({version + ", " + driver, [&] { renderer.render(); }, [&] { return renderer.picture(); },
        [&] { return renderer.measure_map(); }});
  check(glGetError() == GL_NO_ERROR, "OpenGL found an error");
}

}  // namespace
}  // namespace mars::bench

int main(int argc, char** argv) {
  return mars::bench::main_of("peer-llvmpipe", [&] { mars::bench::run(argc, argv); });
}
