// SPDX-License-Identifier: MIT
// tinygltf's code, in a file of its own because it compiles slowly.
#define TINYGLTF_IMPLEMENTATION
#include <tiny_gltf.h>
