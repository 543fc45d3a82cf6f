// OpenGL objects as owning, move-only types. Their context must be current on creation and destruction.
#pragma once

#include <glad/gl.h>
#include <cassert>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

#include "core/model/preset.h"

namespace tyglab {

/// An error of OpenGL (or EGL). `what()` names the problem and the remedy, with the log of a shader.
class GraphicsError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace tyglab

namespace tyglab::gl {

/// Owns one name; `Traits` makes and deletes it.
template <class Traits>
class Object {
 public:
  Object() : id_(Traits::make()) { assert(id_ != 0); }  // 0: no context is current
  ~Object() { reset(); }
  Object(Object&& other) noexcept : id_(std::exchange(other.id_, 0)) {}
  Object& operator=(Object&& other) noexcept {
    if (this != &other) reset(), id_ = std::exchange(other.id_, 0);
    return *this;
  }
  GLuint id() const { return id_; }

 private:
  void reset() {
    if (id_ != 0) Traits::destroy(id_);
  }
  GLuint id_;
};

/// Traits of objects that OpenGL creates in lists: glGenX and glDeleteX by their addresses.
template <auto generate, auto destroy_listed>
struct ListTraits {
  static GLuint make() {
    GLuint id = 0;
    (*generate)(1, &id);
    return id;
  }
  static void destroy(GLuint id) { (*destroy_listed)(1, &id); }
};
struct ProgramTraits {
  static GLuint make() { return glCreateProgram(); }
  static void destroy(GLuint id) { glDeleteProgram(id); }
};

using BufferName = Object<ListTraits<&glGenBuffers, &glDeleteBuffers>>;
using VertexArray = Object<ListTraits<&glGenVertexArrays, &glDeleteVertexArrays>>;
using Texture = Object<ListTraits<&glGenTextures, &glDeleteTextures>>;
using Renderbuffer = Object<ListTraits<&glGenRenderbuffers, &glDeleteRenderbuffers>>;
using Framebuffer = Object<ListTraits<&glGenFramebuffers, &glDeleteFramebuffers>>;
using Query = Object<ListTraits<&glGenQueries, &glDeleteQueries>>;

/// A buffer that is written whole, and keeps its storage while the size stays.
class Buffer {
 public:
  GLuint id() const { return object_.id(); }
  GLsizeiptr bytes() const { return bytes_; }
  /// Binds it to `target` and replaces the content.
  void write(GLenum target, const void* data, std::size_t bytes);
  template <class T>
  void write(GLenum target, const std::vector<T>& data) {
    write(target, data.data(), data.size() * sizeof(T));
  }

 private:
  BufferName object_;
  GLsizeiptr bytes_ = 0;
};

/// A linked program made of the files "shaders/NAME.vert" and "….frag".
class Program {
 public:
  struct Files {
    std::string_view vertex, fragment;
    std::string_view define = {};  ///< a name that both see as defined
  };
  /// Throws GraphicsError with the compiler's log, DataFileError if a file is missing.
  explicit Program(const Files& files);
  void use() const { glUseProgram(object_.id()); }
  // Uniforms of the program in use; a name that the compiler dropped is ignored.
  void set(const char* name, int value) const;
  void set(const char* name, float value) const;
  void set(const char* name, glm::vec2 value) const;
  void set(const char* name, glm::vec3 value) const;
  void set(const char* name, glm::vec4 value) const;
  void set(const char* name, const glm::mat4& value) const;

 private:
  GLint location(const char* name) const { return glGetUniformLocation(object_.id(), name); }
  Object<ProgramTraits> object_;
};

}  // namespace tyglab::gl

// Sizes and positions of objects around the cloth.

namespace tyglab {

/// Drawn spheres stay inside the computed ones, so that the flat triangles between particles on them do not cut in.
float drawn_radius(const Body& sphere, double L);
/// A round distance between the ground's lines for a scene of that radius, m: 1, 2 or 5 times a power of ten.
float grid_spacing(float radius);

// Measures how long the graphics card takes to draw, without waiting for it.

class DrawTimer {
 public:
  /// Measures the drawing between these two calls, unless an earlier measurement is pending.
  void begin();
  void end();
  /// Time of the last measured drawing, ms; 0 before the first.
  double ms();

 private:
  gl::Query query_;
  bool running_ = false, asked_ = false;
  double ms_ = 0;
};

}  // namespace tyglab
