
#include "app/render/gl_objects.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <glm/gtc/type_ptr.hpp>
#include <sstream>
#include <string>

#include "app/base/files.h"
#include "app/platform/gl/dialect.h"

namespace tyglab::gl {
namespace {

/// Text of shaders/NAME, with its lines `#include "…"` replaced by those files.
std::string shader_text(std::string_view name) {
  const auto file = data_file("shaders/" + std::string(name));
  std::ifstream stream(file);
  if (!stream) throw GraphicsError("The shader " + file.string() + " cannot be read. Check its permissions.");
  std::ostringstream text;
  for (std::string line; std::getline(stream, line);) {
    if (line.starts_with("#include \"")) {
      const std::size_t begin = line.find('"') + 1;
      text << shader_text(line.substr(begin, line.rfind('"') - begin)) << '\n';
    } else {
      text << line << '\n';
    }
  }
  return text.str();
}

/// A shader that is attached to a program and then lives as long as it.
void attach(GLuint program, GLenum stage, std::string_view name, std::string_view define) {
  std::string text = std::string(shader_version()) + '\n' + shader_preamble();
  if (!define.empty()) text += "#define " + std::string(define) + '\n';
  text += "#line 1\n" + shader_text(name);
  const char* const source = text.c_str();
  const GLuint shader = glCreateShader(stage);
  glShaderSource(shader, 1, &source, nullptr);
  glCompileShader(shader);
  GLint ok = 0;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &ok);
  if (ok == 0) {
    char log[4096] = "";
    glGetShaderInfoLog(shader, sizeof log, nullptr, log);
    glDeleteShader(shader);
    throw GraphicsError("The shader shaders/" + std::string(name) +
                        " does not compile with this graphics driver. A newer Mesa may fix it; the log says:\n" + log);
  }
  glAttachShader(program, shader);
  glDeleteShader(shader);
}

}  // namespace

void Buffer::write(GLenum target, const void* data, std::size_t bytes) {
  glBindBuffer(target, id());
  if (bytes_ != GLsizeiptr(bytes)) {
    bytes_ = GLsizeiptr(bytes);
    glBufferData(target, bytes_, data, GL_DYNAMIC_DRAW);
  } else if (bytes_ > 0) {
    glBufferSubData(target, 0, bytes_, data);
  }
}

Program::Program(const Files& files) {
  const GLuint program = object_.id();
  attach(program, GL_VERTEX_SHADER, files.vertex, files.define);
  attach(program, GL_FRAGMENT_SHADER, files.fragment, files.define);
  glLinkProgram(program);
  GLint ok = 0;
  glGetProgramiv(program, GL_LINK_STATUS, &ok);
  if (ok == 0) {
    char log[4096] = "";
    glGetProgramInfoLog(program, sizeof log, nullptr, log);
    throw GraphicsError("The shaders " + std::string(files.vertex) + " and " + std::string(files.fragment) +
                        " do not link with this graphics driver; the log says:\n" + log);
  }
  const GLuint block = glGetUniformBlockIndex(program, "Frame");
  if (block != GL_INVALID_INDEX) glUniformBlockBinding(program, block, 0);
}

void Program::set(const char* name, int value) const {
  glUniform1i(location(name), value);
}
void Program::set(const char* name, float value) const {
  glUniform1f(location(name), value);
}
void Program::set(const char* name, glm::vec2 value) const {
  glUniform2fv(location(name), 1, glm::value_ptr(value));
}
void Program::set(const char* name, glm::vec3 value) const {
  glUniform3fv(location(name), 1, glm::value_ptr(value));
}
void Program::set(const char* name, glm::vec4 value) const {
  glUniform4fv(location(name), 1, glm::value_ptr(value));
}
void Program::set(const char* name, const glm::mat4& value) const {
  glUniformMatrix4fv(location(name), 1, GL_FALSE, glm::value_ptr(value));
}

}  // namespace tyglab::gl

namespace tyglab {

float drawn_radius(const Body& sphere, double L) {
  const double r = sphere.r;
  return float(std::max(0.99 * r - L * L / (3 * r), 0.8 * r));
}

float grid_spacing(float radius) {
  const float wish = radius / 5, decade = std::pow(10.0f, std::floor(std::log10(wish)));
  const float part = wish / decade;
  return decade * (part < 2 ? 1.0f : part < 5 ? 2.0f : 5.0f);
}

void DrawTimer::begin() {
  if (asked_ || !drawing_can_be_timed()) return;
  glBeginQuery(GL_TIME_ELAPSED, query_.id());
  running_ = true;
}

void DrawTimer::end() {
  if (!running_) return;
  glEndQuery(GL_TIME_ELAPSED);
  running_ = false, asked_ = true;
}

double DrawTimer::ms() {
  GLint there = 0;
  if (asked_) glGetQueryObjectiv(query_.id(), GL_QUERY_RESULT_AVAILABLE, &there);
  if (there == 0) return ms_;
  GLuint nanoseconds = 0;
  glGetQueryObjectuiv(query_.id(), GL_QUERY_RESULT, &nanoseconds);
  asked_ = false;
  return ms_ = 1e-6 * nanoseconds;
}

}  // namespace tyglab
