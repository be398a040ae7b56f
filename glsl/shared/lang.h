// SPDX-License-Identifier: MIT
// What lets one text be GLSL 4.50 and C++20 (GLM): the geometric heart is written once and compiled by both, so that
// unit tests and CPU-side validation run the very text that the GPU runs.
// In C++ write 0.5f never 0.5, no swizzles, no array constructors; compile with floating-point contraction off.
#ifndef IZB_SHARED_LANG_H
#define IZB_SHARED_LANG_H

#ifdef __cplusplus
#include <cstdint>
#include <glm/glm.hpp>
#define IN(T) const T&
#define OUT(T) T&
#define SHARED inline
#define PRECISE
#define SHARED_BEGIN namespace izb::shared { using namespace glm; // NOLINT
#define SHARED_END }
#else
#define IN(T) in T
#define OUT(T) inout T
#define SHARED
#define PRECISE precise
#define SHARED_BEGIN
#define SHARED_END
#endif

#endif
