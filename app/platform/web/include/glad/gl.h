// The declarations of the desktop loader for WebGL 2 (OpenGL ES 3.0), with enough of what it lacks for the code that
// checks for it to compile.
#pragma once

#include <GLES3/gl3.h>

#define GLAD_GL_ARB_buffer_storage 0

#define GL_TIME_ELAPSED 0x88BF
#define GL_CLIENT_STORAGE_BIT 0x0200
#define GL_MAP_PERSISTENT_BIT 0x0040
#define GL_MAP_COHERENT_BIT 0x0080

inline void glBufferStorage(GLenum, GLsizeiptr, const void*, GLbitfield) {}
inline void glGetBufferSubData(GLenum, GLintptr, GLsizeiptr, void*) {}
inline void glGetQueryObjectiv(GLuint, GLenum, GLint* value) {
  *value = 0;
}
inline void glDrawBuffer(GLenum buffer) {
  glDrawBuffers(1, &buffer);
}
inline void* no_mapped_buffer(GLenum, GLintptr, GLsizeiptr, GLbitfield) {
  return nullptr;
}
#define glMapBufferRange no_mapped_buffer
