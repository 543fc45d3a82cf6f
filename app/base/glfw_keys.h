// GLFW's names of keys, buttons and modifiers, without OpenGL.
#pragma once

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
