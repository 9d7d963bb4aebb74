// Mesa's llvmpipe draws a crowd, with skins in its vertex shader: peer-llvmpipe-crowd CROWD THREADS SAMPLES.
//
// The mesh is in buffers once; a frame is one draw call a figure, nearest first, with its bones as uniforms, and
// glReadPixels.
#include <algorithm>
#include <functional>
#include <numeric>

#include "tests/bench/peers/gl_parts.h"
#include "tests/bench/peers/gl_shaders.h"
#include "tests/bench/peers/peer.h"
#include "tests/bench/peers/crowd.h"

namespace mars::bench {
namespace {

class CrowdRenderer {
 public:
  CrowdRenderer(const Crowd& crowd, int samples)
      : crowd_(crowd),
        head_(crowd.head.mesh),
        width_(static_cast<GLsizei>(head_.width)),
        height_(static_cast<GLsizei>(head_.height)),
        frame_(head_.frames - 1),
        pixels_(std::size_t{head_.width} * head_.height) {
    glEnable(GL_DEPTH_TEST);
    glEnable(GL_CULL_FACE);
    glFrontFace(GL_CW);
    glClearColor(head_.background[0], head_.background[1], head_.background[2], 1);
    load();
    const Shaders shaders = skin_shaders(head_, static_cast<int>(crowd.head.bones));
    const GLuint program = link_program(shaders.vertex, shaders.fragment);
    glUseProgram(program);
    bones_at_ = glGetUniformLocation(program, "bones");
    glUniform3fv(glGetUniformLocation(program, "own"), 1, crowd.look.data());
    if (samples > 1) resolved_ = framebuffer(width_, height_, 0);
    drawn_ = framebuffer(width_, height_, samples > 1 ? samples : 0);
  }

  void render() {
    frame_ = (frame_ + 1) % head_.frames;
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, drawn_);
    glViewport(0, 0, width_, height_);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    for (const std::uint32_t figure : nearest_first()) draw(figure);
    const Box all{0, 0, width_, height_};
    if (resolved_ != 0) copy(all, drawn_, resolved_, GL_COLOR_BUFFER_BIT);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, resolved_ != 0 ? resolved_ : drawn_);
    glReadPixels(0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE, pixels_.data());
  }

  Picture picture() const { return {head_.width, head_.height, pixels_}; }

 private:
  void load() {
    GLuint names[3];
    glGenVertexArrays(1, &names[2]);
    glBindVertexArray(names[2]);
    glGenBuffers(2, names);
    glBindBuffer(GL_ARRAY_BUFFER, names[0]);
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(crowd_.vertices.size() * sizeof(SkinVertex)),
                 crowd_.vertices.data(), GL_STATIC_DRAW);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, names[1]);
    glBufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(crowd_.triangles.size() * sizeof(Corners)),
                 crowd_.triangles.data(), GL_STATIC_DRAW);
    const auto at = [](std::size_t offset) { return reinterpret_cast<void*>(offset); };
    for (GLuint k = 0; k < 4; ++k) glEnableVertexAttribArray(k);
    glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, sizeof(SkinVertex), at(offsetof(SkinVertex, place)));
    glVertexAttribPointer(1, 3, GL_FLOAT, GL_FALSE, sizeof(SkinVertex), at(offsetof(SkinVertex, normal)));
    glVertexAttribIPointer(2, 4, GL_UNSIGNED_INT, sizeof(SkinVertex), at(offsetof(SkinVertex, bone)));
    glVertexAttribPointer(3, 4, GL_FLOAT, GL_FALSE, sizeof(SkinVertex), at(offsetof(SkinVertex, weight)));
  }

  const Motion* bones_of(std::uint32_t figure) const {
    return crowd_.bones.data() + (std::size_t{frame_} * head_.patches + figure) * crowd_.head.bones;
  }

  // So that what is hidden is not shaded.
  std::vector<std::uint32_t> nearest_first() const {
    std::vector<std::uint32_t> figures(head_.patches);
    std::iota(figures.begin(), figures.end(), 0u);
    std::ranges::sort(figures, std::greater(), [&](std::uint32_t figure) { return (*bones_of(figure))[2][3]; });
    return figures;
  }

  void draw(std::uint32_t figure) {
    columns_.clear();
    for (std::uint32_t bone = 0; bone < crowd_.head.bones; ++bone)
      for (std::size_t c = 0; c < 4; ++c)
        for (std::size_t r = 0; r < 3; ++r) columns_.push_back(bones_of(figure)[bone][r][c]);
    glUniformMatrix4x3fv(bones_at_, static_cast<GLsizei>(crowd_.head.bones), GL_FALSE, columns_.data());
    glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(3 * crowd_.triangles.size()), GL_UNSIGNED_INT, nullptr);
  }

  const Crowd& crowd_;
  const MeshHead& head_;
  GLsizei width_, height_;
  GLint bones_at_ = 0;
  GLuint drawn_ = 0, resolved_ = 0;  // the second only where there are several samples
  std::uint32_t frame_;
  std::vector<float> columns_;
  std::vector<std::uint32_t> pixels_;
};

void run(int argc, char** argv) {
  check(argc == 4, "usage: peer-llvmpipe-crowd CROWD THREADS SAMPLES");
  begin_gl(argv[2]);
  const Crowd crowd = read_crowd(argv[1]);
  CrowdRenderer renderer(crowd, std::stoi(argv[3]));
  const std::string driver = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  obey({driver, [&] { renderer.render(); }, [&] { return renderer.picture(); }, {}});
  check(glGetError() == GL_NO_ERROR, "OpenGL found an error");
}

}  // namespace
}  // namespace mars::bench

int main(int argc, char** argv) {
  return mars::bench::main_of("peer-llvmpipe-crowd", [&] { mars::bench::run(argc, argv); });
}
