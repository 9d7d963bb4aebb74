// What peer-llvmpipe needs of OpenGL: a context without a window, programs, framebuffers, rectangles of pictures.
#pragma once

#define GL_GLEXT_PROTOTYPES
#include <GL/gl.h>
#include <GL/glext.h>

#include <sstream>
#include <string>

namespace mars::bench {

// Throws std::runtime_error with `what` unless all is `fine`.
void check(bool fine, const std::string& what);

// llvmpipe with this many threads.
void begin_gl(const char* threads);

// Of the texts of a vertex and a fragment shader.
GLuint link_program(const std::string& vertex, const std::string& fragment);

// A line of a shader that gives numbers a name.
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

struct Box {
  GLint left, top;  // lines as in the picture
  GLsizei width, height;
};

// The box round both.
Box round(const Box& a, const Box& b);

// Of colour and depth. `samples` 0: not multisampled.
GLuint framebuffer(GLsizei width, GLsizei height, GLsizei samples);

// Adds to the framebuffer that is bound a texture that it draws into, as its colour of that number.
GLuint add_texture(GLuint number, GLenum format, GLsizei width, GLsizei height, GLsizei samples);

void check_framebuffer();

void copy(const Box& box, GLuint from, GLuint to, GLbitfield what);

}  // namespace mars::bench
