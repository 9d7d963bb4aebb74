#include "tests/bench/peers/gl_parts.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <malloc.h>

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <stdexcept>

namespace mars::bench {
namespace {

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

}  // namespace

void check(bool fine, const std::string& what) {
  if (!fine) throw std::runtime_error(what);
}

void begin_gl(const char* threads) {
  // Mesa takes its memory again for every frame: it shall not go back to the system in between.
  mallopt(M_MMAP_THRESHOLD, 1 << 30);
  mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
  setenv("LP_NUM_THREADS", threads, 1);
  setenv("GALLIUM_DRIVER", "llvmpipe", 1);
  setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
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
  const std::string driver = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  check(driver.find("llvmpipe") != std::string::npos, "not llvmpipe but " + driver);
}

GLuint link_program(const std::string& vertex, const std::string& fragment) {
  const GLuint program = glCreateProgram();
  glAttachShader(program, compile(GL_VERTEX_SHADER, vertex));
  glAttachShader(program, compile(GL_FRAGMENT_SHADER, fragment));
  glLinkProgram(program);
  GLint fine = 0;
  glGetProgramiv(program, GL_LINK_STATUS, &fine);
  check(fine, "the shaders do not fit each other");
  return program;
}

Box round(const Box& a, const Box& b) {
  if (a.width == 0) return b;
  if (b.width == 0) return a;
  const GLint left = std::min(a.left, b.left), top = std::min(a.top, b.top);
  return {left, top, std::max(a.left + a.width, b.left + b.width) - left,
          std::max(a.top + a.height, b.top + b.height) - top};
}

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
  check_framebuffer();
  return names[0];
}

GLuint add_texture(GLuint number, GLenum format, GLsizei width, GLsizei height, GLsizei samples) {
  const GLenum kind = samples > 0 ? GL_TEXTURE_2D_MULTISAMPLE : GL_TEXTURE_2D;
  GLuint texture;
  glGenTextures(1, &texture);
  glBindTexture(kind, texture);
  if (samples > 0)
    glTexImage2DMultisample(kind, samples, format, width, height, GL_TRUE);
  else
    glTexStorage2D(kind, 1, format, width, height);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0 + number, kind, texture, 0);
  return texture;
}

void check_framebuffer() {
  check(glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE, "no framebuffer of this size");
}

void copy(const Box& box, GLuint from, GLuint to, GLbitfield what) {
  const GLint right = box.left + box.width, bottom = box.top + box.height;
  glBindFramebuffer(GL_READ_FRAMEBUFFER, from);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, to);
  glBlitFramebuffer(box.left, box.top, right, bottom, box.left, box.top, right, bottom, what, GL_NEAREST);
}

}  // namespace mars::bench
