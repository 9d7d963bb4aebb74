// Mesa's llvmpipe as a competitor: peer-llvmpipe MESH THREADS whole|inbetween SAMPLES, or peer-llvmpipe MESH THREADS
// film SAMPLES FOLDER ENCODER, or peer-llvmpipe encoders, which names these. How it was made fast: README.md.
//
// The scene is in buffers once; a frame is a few draw calls and glReadPixels. Inbetweens begin from the standing
// part's colours and depths, which another framebuffer keeps. Several samples a pixel are drawn and kept in
// multisampled framebuffers, and resolved before they are read. Of a film, the standing part is drawn for the first
// frame, and each frame is written to a file while the next ones are drawn.
#define GL_GLEXT_PROTOTYPES
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GL/gl.h>
#include <GL/glext.h>
#include <malloc.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <limits>
#include <map>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <tuple>

#include "tests/bench/peers/cover.h"
#include "tests/bench/peers/frame_files.h"
#include "tests/bench/peers/mesh.h"
#include "tests/bench/peers/peer.h"

namespace mars::bench {
namespace {

// What stays the same for a scene is written into the shaders as numbers. Pictures are drawn upside down: OpenGL's
// first line is the upper one then, and llvmpipe's samples are where ours are.
constexpr const char* kVertexShader = R"(
layout(location = 0) in vec3 place;
layout(location = 1) in vec3 normal;
uniform mat4x3 motion;
centroid out vec3 n;
void main() {
  vec3 p = motion * vec4(place, 1.0);
  gl_Position = vec4(LENS.x * p.x, -LENS.y * p.y, -LENS.z * p.z + LENS.w, -p.z);
  n = mat3(motion) * normal;
}
)";

constexpr const char* kFragmentShader = R"(
centroid in vec3 n;
uniform vec3 own;
out vec4 pixel;
void main() {
  vec3 d = vec3(gl_FragCoord.x * REACH.x + REACH.y, REACH.z - gl_FragCoord.y * REACH.x, -1.0);
  float shrink = inversesqrt(dot(n, n)), toward = -inversesqrt(dot(d, d));
  float nl = dot(n, TO_LIGHT) * shrink;
  float nv = dot(n, d) * shrink * toward;
  float shine = nl > 0.0 ? clamp(2.0 * nl * nv - dot(d, TO_LIGHT) * toward, 0.0, 1.0) : 0.0;
  for (int k = 0; k < SQUARINGS; ++k) shine *= shine;
  pixel = vec4(own * (AMBIENT + DIFFUSE * LIGHT * max(nl, 0.0)) + SPECULAR * LIGHT * shine, 1.0);
}
)";

template <typename... Numbers>
std::string defined(const char* name, const char* type, Numbers... numbers) {
  std::ostringstream text;
  text.precision(9);
  text << "#define " << name << ' ' << type << '(';
  const char* comma = "";
  ((text << comma << numbers, comma = ", "), ...);
  text << ")\n";
  return text.str();
}

// The film's numbers for both shaders. LENS: scale over half the picture's width and height, depth z * w = c * z + d;
// REACH: of a pixel in the eye's plane at 1, and the upper left corner.
std::string numbers_of(const MeshHead& head) {
  const float far = 1000, near = head.near;
  const auto w = static_cast<float>(head.width), h = static_cast<float>(head.height);
  return "#version 330 core\n" +
         defined("LENS", "vec4", 2 * head.scale / w, 2 * head.scale / h, (far + near) / (far - near),
                 -2 * far * near / (far - near)) +
         defined("REACH", "vec3", 1 / head.scale, -head.center[0] / head.scale, head.center[1] / head.scale) +
         defined("TO_LIGHT", "vec3", head.to_light[0], head.to_light[1], head.to_light[2]) +
         defined("LIGHT", "vec3", head.light[0], head.light[1], head.light[2]) +
         defined("AMBIENT", "float", head.ambient) + defined("DIFFUSE", "float", head.diffuse) +
         defined("SPECULAR", "float", head.specular) + defined("SQUARINGS", "int", head.squarings);
}

void check(bool fine, const std::string& what) {
  if (!fine) throw std::runtime_error(what);
}

// A context without a window.
void begin_gl() {
  const auto get_display =
      reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(eglGetProcAddress("eglGetPlatformDisplayEXT"));
  check(get_display != nullptr, "this EGL has no platforms");
  EGLDisplay display = get_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
  check(eglInitialize(display, nullptr, nullptr) == EGL_TRUE, "EGL cannot begin without a window");
  eglBindAPI(EGL_OPENGL_API);
  const EGLint wanted[] = {EGL_CONTEXT_MAJOR_VERSION, 3, EGL_CONTEXT_MINOR_VERSION, 3, EGL_NONE};
  EGLContext context = eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, wanted);
  check(context != EGL_NO_CONTEXT, "EGL gives no context of OpenGL 3.3");
  check(eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context) == EGL_TRUE, "EGL needs a surface here");
}

GLuint compile(GLenum kind, const std::string& text) {
  const GLuint shader = glCreateShader(kind);
  const char* source = text.c_str();
  glShaderSource(shader, 1, &source, nullptr);
  glCompileShader(shader);
  GLint fine = 0;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &fine);
  char words[1024] = "";
  if (!fine) glGetShaderInfoLog(shader, sizeof words, nullptr, words);
  check(fine, words);
  return shader;
}

GLuint link(const MeshHead& head) {
  const std::string numbers = numbers_of(head);
  const GLuint program = glCreateProgram();
  glAttachShader(program, compile(GL_VERTEX_SHADER, numbers + kVertexShader));
  glAttachShader(program, compile(GL_FRAGMENT_SHADER, numbers + kFragmentShader));
  glLinkProgram(program);
  GLint fine = 0;
  glGetProgramiv(program, GL_LINK_STATUS, &fine);
  check(fine, "the shaders do not fit each other");
  return program;
}

struct Box {
  GLint left, top;  // lines as in the picture
  GLsizei width, height;
};

// The box round both.
Box round(const Box& a, const Box& b) {
  if (a.width == 0) return b;
  if (b.width == 0) return a;
  const GLint left = std::min(a.left, b.left), top = std::min(a.top, b.top);
  return {left, top, std::max(a.left + a.width, b.left + b.width) - left,
          std::max(a.top + a.height, b.top + b.height) - top};
}

// `samples` 0: not multisampled.
GLuint framebuffer(GLsizei width, GLsizei height, GLsizei samples) {
  GLuint names[3];
  glGenFramebuffers(1, &names[0]);
  glBindFramebuffer(GL_FRAMEBUFFER, names[0]);
  glGenRenderbuffers(2, &names[1]);
  glBindRenderbuffer(GL_RENDERBUFFER, names[1]);
  glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples, GL_RGBA8, width, height);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, names[1]);
  glBindRenderbuffer(GL_RENDERBUFFER, names[2]);
  glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples, GL_DEPTH_COMPONENT32F, width, height);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, names[2]);
  check(glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE, "no framebuffer of this size");
  return names[0];
}

void copy(const Box& box, GLuint from, GLuint to, GLbitfield what) {
  const GLint right = box.left + box.width, bottom = box.top + box.height;
  glBindFramebuffer(GL_READ_FRAMEBUFFER, from);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, to);
  glBlitFramebuffer(box.left, box.top, right, bottom, box.left, box.top, right, bottom, what, GL_NEAREST);
}

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

class Renderer {
 public:
  // `files`: of a film's frames; none in other courses.
  Renderer(const Mesh& mesh, Course course, int samples, FrameFiles* files);

  void render();
  Picture picture() const { return {mesh_.head.width, mesh_.head.height, *shown_}; }

 private:
  void load();
  void set_motion(const Motion& motion);
  void draw(bool moving, const Motion& motion);
  void render_whole();
  void keep_standing();
  Box draw_mover();
  void render_inbetween();
  void render_of_film();
  Box mover_box(const Motion& motion) const;
  Box whole() const { return {0, 0, width_, height_}; }
  void read(const Box& box, std::vector<std::uint32_t>& pixels);

  const Mesh& mesh_;
  Course course_;
  FrameFiles* files_;
  GLsizei width_, height_;
  GLuint program_ = 0, drawn_ = 0, kept_ = 0, resolved_ = 0;  // the last only where there are several samples
  GLint motion_at_ = -1, own_at_ = -1;
  std::vector<Batch> batches_[2];  // what stands, what moves
  std::uint32_t number_;           // of the last frame rendered; inbetweens are all but 0
  std::vector<Outline> mover_;
  Box before_{};                 // where what was drawn differs from what stands
  std::vector<Box> in_buffers_;  // the same of each of the files' buffers
  std::vector<std::uint32_t> pixels_;
  const std::vector<std::uint32_t>* shown_ = &pixels_;
};

constexpr Motion kStill{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};

Renderer::Renderer(const Mesh& mesh, Course course, int samples, FrameFiles* files)
    : mesh_(mesh),
      course_(course),
      files_(files),
      width_(static_cast<GLsizei>(mesh.head.width)),
      height_(static_cast<GLsizei>(mesh.head.height)),
      number_(mesh.head.frames - 1),
      mover_(outlines_of(mesh, true)),
      pixels_(mesh.head.width * std::size_t{mesh.head.height}) {
  const MeshHead& head = mesh.head;
  program_ = link(head);
  glUseProgram(program_);
  motion_at_ = glGetUniformLocation(program_, "motion");
  own_at_ = glGetUniformLocation(program_, "own");
  load();
  glEnable(GL_DEPTH_TEST);
  glEnable(GL_CULL_FACE);
  glFrontFace(GL_CW);
  glClearColor(head.background[0], head.background[1], head.background[2], 1);
  glViewport(0, 0, width_, height_);
  glPixelStorei(GL_PACK_ROW_LENGTH, width_);
  if (samples > 1) resolved_ = framebuffer(width_, height_, 0);
  kept_ = framebuffer(width_, height_, samples > 1 ? samples : 0);
  drawn_ = framebuffer(width_, height_, samples > 1 ? samples : 0);
  if (course_ != Course::inbetween) return;
  keep_standing();
  copy(whole(), kept_, drawn_, GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  read(whole(), pixels_);
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

void Renderer::set_motion(const Motion& m) {
  const float columns[12] = {m[0][0], m[1][0], m[2][0], m[0][1], m[1][1], m[2][1],
                             m[0][2], m[1][2], m[2][2], m[0][3], m[1][3], m[2][3]};
  glUniformMatrix4x3fv(motion_at_, 1, GL_FALSE, columns);
}

void Renderer::draw(bool moving, const Motion& motion) {
  set_motion(motion);
  for (const Batch& batch : batches_[moving]) {
    glUniform3fv(own_at_, 1, mesh_.looks[batch.look].data());
    glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(batch.count), GL_UNSIGNED_INT,
                   reinterpret_cast<void*>(batch.first * sizeof(std::uint32_t)));
  }
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
void Renderer::read(const Box& box, std::vector<std::uint32_t>& pixels) {
  if (resolved_ != 0) copy(box, drawn_, resolved_, GL_COLOR_BUFFER_BIT);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, resolved_ != 0 ? resolved_ : drawn_);
  glReadPixels(box.left, box.top, box.width, box.height, GL_RGBA, GL_UNSIGNED_BYTE,
               &pixels[static_cast<std::size_t>(box.top) * mesh_.head.width + static_cast<std::size_t>(box.left)]);
}

void Renderer::render_whole() {
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, drawn_);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  draw(true, mesh_.motion[number_]);  // it is in front, and hides
  draw(false, kStill);
  read(whole(), pixels_);
}

void Renderer::keep_standing() {
  glBindFramebuffer(GL_FRAMEBUFFER, kept_);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  draw(false, kStill);
}

// Over what stands; where it is.
Box Renderer::draw_mover() {
  const Box now = mover_box(mesh_.motion[number_]);
  copy(round(before_, now), kept_, drawn_, GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  before_ = now;
  draw(true, mesh_.motion[number_]);
  return now;
}

void Renderer::render_inbetween() {
  const Box before = before_;
  read(round(before, draw_mover()), pixels_);
}

void Renderer::render_of_film() {
  if (number_ == 0) {
    keep_standing();
    before_ = whole();
    in_buffers_.assign(files_->buffers().size(), whole());
  }
  const Box now = draw_mover();
  const std::size_t at = files_->free_buffer();
  FrameBuffer& buffer = files_->buffers()[at];
  read(round(in_buffers_[at], now), buffer.pixels);
  in_buffers_[at] = now;
  buffer.number = number_;
  shown_ = &buffer.pixels;
  files_->submit(at);
  if (number_ + 1 == mesh_.head.frames) files_->finish();
}

Box Renderer::mover_box(const Motion& motion) const {
  Box box{};
  for (const Outline& outline : mover_) {
    const Area area = cover(outline, mesh_.head, motion);
    box = round(box, {area.left, area.top, area.right - area.left, area.bottom - area.top});
  }
  return box;
}

Course course_of(std::string_view word) {
  if (word == "whole") return Course::whole;
  if (word == "inbetween") return Course::inbetween;
  check(word == "film", "none of whole, inbetween, film: " + std::string(word));
  return Course::film;
}

void run(int argc, char** argv) {
  if (argc == 2 && argv[1] == std::string_view("encoders")) {
    for (const std::string& name : png_encoders()) std::cout << name << '\n';
    return;
  }
  check(argc >= 5, "usage: peer-llvmpipe MESH THREADS whole|inbetween|film SAMPLES [FOLDER ENCODER]");
  const Course course = course_of(argv[3]);
  check(argc == (course == Course::film ? 7 : 5), "a film has a folder and an encoder, other courses have none");
  // Mesa takes its memory again for every frame: it shall not go back to the system in between.
  mallopt(M_MMAP_THRESHOLD, 1 << 30);
  mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
  setenv("LP_NUM_THREADS", argv[2], 1);
  setenv("GALLIUM_DRIVER", "llvmpipe", 1);
  setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
  begin_gl();
  const Mesh mesh = read_mesh(argv[1]);
  const int samples = std::stoi(argv[4]);
  GLint most = 0;
  glGetIntegerv(GL_MAX_SAMPLES, &most);
  check(samples == 1 || samples <= most, "llvmpipe has " + std::to_string(most) + " samples a pixel at most");
  std::optional<FrameFiles> files;
  if (course == Course::film) files.emplace(argv[5], argv[6], mesh.head.width, mesh.head.height);
  Renderer renderer(mesh, course, samples, files ? &*files : nullptr);
  const std::string driver = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  check(driver.find("llvmpipe") != std::string::npos, "not llvmpipe but " + driver);
  const std::string version = reinterpret_cast<const char*>(glGetString(GL_VERSION));
  obey({version + ", " + driver, [&] { renderer.render(); }, [&] { return renderer.picture(); }});
  check(glGetError() == GL_NO_ERROR, "OpenGL found an error");
}

}  // namespace
}  // namespace mars::bench

int main(int argc, char** argv) {
  return mars::bench::main_of("peer-llvmpipe", [&] { mars::bench::run(argc, argv); });
}
