// SPDX-License-Identifier: MIT
// Structs that C++ and GLSL share: the driver's view of every block of every program, compiled and from the cache,
// against offsetof.
#include <gtest/gtest.h>

#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "base/error.h"
#include "chosen_programs.h"
#include "gl/gl_test.h"
#include "gpu/program.h"
#include "gpu/program_cache.h"
#include "shared/bounds.h"
#include "shared/deform.h"
#include "shared/depth_map.h"
#include "shared/lists.h"
#include "shared/micro_quad.h"
#include "shared/pairs.h"
#include "shared/sweep.h"

namespace {

using namespace izb::shared;

struct Field {
  GLint offset, type;
  auto operator<=>(const Field&) const = default;
};

void PrintTo(const Field& field, std::ostream* out) {
  *out << "offset " << field.offset << ", type 0x" << std::hex << field.type << std::dec;
}

struct Block {
  size_t bytes;  ///< of the struct, or of one element of an array
  bool array;    ///< an array without length
  std::map<std::string, Field> fields;
};

template <typename T>
constexpr GLint gl_type = 0;
template <>
constexpr GLint gl_type<vec4> = GL_FLOAT_VEC4;
template <>
constexpr GLint gl_type<uvec4> = GL_UNSIGNED_INT_VEC4;
template <>
constexpr GLint gl_type<mat4> = GL_FLOAT_MAT4;
template <>
constexpr GLint gl_type<uint> = GL_UNSIGNED_INT;
template <>
constexpr GLint gl_type<float> = GL_FLOAT;

#define FIELD(prefix, type, name)                                \
  {                                                              \
    prefix "." #name, {                                          \
      GLint(offsetof(type, name)), gl_type<decltype(type::name)> \
    }                                                            \
  }

const std::map<std::string, Block> blocks{
    {"CameraBlock",
     {sizeof(CameraFrame),
      false,
      {FIELD("camera", CameraFrame, clip_from_view), FIELD("camera", CameraFrame, pixel_ray),
       FIELD("camera", CameraFrame, footprint), FIELD("camera", CameraFrame, size_px)}}},
    {"LightBlock",
     {sizeof(LightFrame),
      false,
      {FIELD("light", LightFrame, axis_x), FIELD("light", LightFrame, axis_y), FIELD("light", LightFrame, axis_z),
       FIELD("light", LightFrame, origin), FIELD("light", LightFrame, to_light), FIELD("light", LightFrame, color),
       FIELD("light", LightFrame, grid)}}},
    {"ShadeBlock",
     {sizeof(ShadeFrame),
      false,
      {FIELD("shade", ShadeFrame, up_vs), FIELD("shade", ShadeFrame, sky_horizon),
       FIELD("shade", ShadeFrame, sky_zenith), FIELD("shade", ShadeFrame, ground), FIELD("shade", ShadeFrame, cone),
       FIELD("shade", ShadeFrame, strength)}}},
    {"ExposureBlock", {sizeof(Exposure), false, {FIELD("exposure", Exposure, scale)}}},
    {"ExposedBlock", {sizeof(Exposure), false, {FIELD("exposure", Exposure, scale)}}},
    {"MeterBlock", {sizeof(float), true, {{"brought[0]", {0, GL_FLOAT}}}}},
    {"WindowBlock",
     {sizeof(LightWindow),
      true,
      {FIELD("windows[0]", LightWindow, window), FIELD("windows[0]", LightWindow, depth),
       FIELD("windows[0]", LightWindow, guard)}}},
    {"BoundsBlock",
     {sizeof(ReceiverBounds),
      true,
      {FIELD("all_bounds[0]", ReceiverBounds, low), FIELD("all_bounds[0]", ReceiverBounds, high),
       FIELD("all_bounds[0]", ReceiverBounds, slack)}}},
    {"CascadeBlock",
     {sizeof(CascadeRange),
      false,
      {FIELD("range", CascadeRange, reached), {"range.ends[0]", {offsetof(CascadeRange, ends), GL_FLOAT_VEC4}}}}},
    {"SampleBlock",
     {sizeof(SampleFrame),
      false,
      {{"samples.offset_px[0]", {offsetof(SampleFrame, offset_px), GL_FLOAT_VEC4}},
       FIELD("samples", SampleFrame, info)}}},
    {"PoolBlock",
     {sizeof(PoolCounters),
      false,
      {FIELD("pool", PoolCounters, nodes), FIELD("pool", PoolCounters, largest_quad),
       FIELD("pool", PoolCounters, carries), FIELD("pool", PoolCounters, unused)}}},
    {"MapCounterBlock",
     {sizeof(MapCounters),
      false,
      {FIELD("counters", MapCounters, receivers), FIELD("counters", MapCounters, comparisons),
       FIELD("counters", MapCounters, outside), FIELD("counters", MapCounters, unused)}}},
    {"CounterBlock",
     {sizeof(Counters),
      false,
      {FIELD("counters", Counters, pairs), FIELD("counters", Counters, capacity),
       FIELD("counters", Counters, fragments), FIELD("counters", Counters, visibility_tests),
       FIELD("counters", Counters, triangles), FIELD("counters", Counters, removed),
       FIELD("counters", Counters, unchanged), FIELD("counters", Counters, unfinished),
       FIELD("counters", Counters, carries), FIELD("counters", Counters, stored),
       FIELD("counters", Counters, unstorable), FIELD("counters", Counters, asked),
       FIELD("counters", Counters, asked_capacity), FIELD("counters", Counters, drawn),
       FIELD("counters", Counters, unused0), FIELD("counters", Counters, unused1)}}},
    {"ListedBlock",
     {sizeof(ListedTriangle),
      true,
      {FIELD("listed[0]", ListedTriangle, instance), FIELD("listed[0]", ListedTriangle, triangle_and_layer),
       FIELD("listed[0]", ListedTriangle, place), FIELD("listed[0]", ListedTriangle, node)}}},
    {"ListedCountBlock",
     {sizeof(ListedCounts),
      false,
      {{"counts.part[0]", {offsetof(ListedCounts, part), GL_UNSIGNED_INT_VEC4}},
       FIELD("counts", ListedCounts, rows),
       FIELD("counts", ListedCounts, room),
       FIELD("counts", ListedCounts, vertices),
       FIELD("counts", ListedCounts, draw_instances),
       FIELD("counts", ListedCounts, first_vertex),
       FIELD("counts", ListedCounts, first_instance)}}},
    {"InstanceBlock",
     {sizeof(InstanceFrame),
      true,
      {FIELD("instances[0]", InstanceFrame, row_x), FIELD("instances[0]", InstanceFrame, row_y),
       FIELD("instances[0]", InstanceFrame, row_z), FIELD("instances[0]", InstanceFrame, info)}}},
    {"MaterialBlock",
     {sizeof(MaterialFrame),
      true,
      {FIELD("materials[0]", MaterialFrame, base_color), FIELD("materials[0]", MaterialFrame, uv_u),
       FIELD("materials[0]", MaterialFrame, uv_v), FIELD("materials[0]", MaterialFrame, alpha)}}},
    {"PairBlock",
     {sizeof(UnsurePair),
      true,
      {FIELD("pairs[0]", UnsurePair, node), FIELD("pairs[0]", UnsurePair, instance),
       FIELD("pairs[0]", UnsurePair, triangle)}}},
    {"AskedBlock",
     {sizeof(UnsurePair),
      true,
      {FIELD("asked[0]", UnsurePair, node), FIELD("asked[0]", UnsurePair, instance),
       FIELD("asked[0]", UnsurePair, triangle)}}},
    {"RestPositionBlock", {sizeof(float), true, {{"rest_positions[0]", {0, GL_FLOAT}}}}},
    {"RestNormalBlock", {sizeof(float), true, {{"rest_normals[0]", {0, GL_FLOAT}}}}},
    {"TargetBlock", {sizeof(float), true, {{"targets[0]", {0, GL_FLOAT}}}}},
    {"MorphWeightBlock", {sizeof(float), true, {{"morph_weights[0]", {0, GL_FLOAT}}}}},
    {"DeformedPositionBlock", {sizeof(float), true, {{"deformed_positions[0]", {0, GL_FLOAT}}}}},
    {"DeformedNormalBlock", {sizeof(float), true, {{"deformed_normals[0]", {0, GL_FLOAT}}}}},
    {"InfluenceBlock",
     {sizeof(InfluenceFrame),
      true,
      {FIELD("influences[0]", InfluenceFrame, joint), FIELD("influences[0]", InfluenceFrame, weight)}}},
    {"JointBlock",
     {sizeof(JointFrame),
      true,
      {FIELD("joints[0]", JointFrame, row_x), FIELD("joints[0]", JointFrame, row_y),
       FIELD("joints[0]", JointFrame, row_z)}}},
    {"PositionBlock", {sizeof(float), true, {{"positions[0]", {0, GL_FLOAT}}}}},
    {"IndexBlock", {sizeof(uint), true, {{"indices[0]", {0, GL_UNSIGNED_INT}}}}},
    {"MorePositionBlock", {sizeof(float), true, {{"MorePositionBlock.positions[0]", {0, GL_FLOAT}}}}},
    {"MoreIndexBlock", {sizeof(uint), true, {{"MoreIndexBlock.indices[0]", {0, GL_UNSIGNED_INT}}}}},
};

GLint property(GLuint program, GLenum interface, GLuint index, GLenum name) {
  GLint value = -1;
  glGetProgramResourceiv(program, interface, index, 1, &name, 1, nullptr, &value);
  return value;
}

std::string resource_name(GLuint program, GLenum interface, GLuint index) {
  char text[128] = {};
  glGetProgramResourceName(program, interface, index, sizeof text, nullptr, text);
  return text;
}

GLuint resource_count(GLuint program, GLenum interface) {
  GLint count = 0;
  glGetProgramInterfaceiv(program, interface, GL_ACTIVE_RESOURCES, &count);
  return static_cast<GLuint>(count);
}

/// Without the number of an array's element.
std::string block_name_of(GLuint program, GLenum interface, GLuint index) {
  const std::string name = resource_name(program, interface, index);
  return name.substr(0, name.find('['));
}

/// Compares one interface of a program with the table; notes the fields that it met.
void compare(GLuint program, bool storage, std::map<std::string, std::set<std::string>>& met) {
  const GLenum block_interface = storage ? GL_SHADER_STORAGE_BLOCK : GL_UNIFORM_BLOCK;
  const GLenum field_interface = storage ? GL_BUFFER_VARIABLE : GL_UNIFORM;
  for (GLuint i = 0; i < resource_count(program, block_interface); ++i) {
    const std::string name = block_name_of(program, block_interface, i);
    const auto block = blocks.find(name);
    ASSERT_NE(block, blocks.end()) << "block " << name << " is not in the table of this test";
    if (!block->second.array) {
      EXPECT_EQ(size_t(property(program, block_interface, i, GL_BUFFER_DATA_SIZE)), block->second.bytes) << name;
    }
  }
  for (GLuint i = 0; i < resource_count(program, field_interface); ++i) {
    const GLint block_index = property(program, field_interface, i, GL_BLOCK_INDEX);
    if (block_index < 0) continue;  // a sampler or image
    const std::string block_name = block_name_of(program, block_interface, static_cast<GLuint>(block_index));
    const Block& block = blocks.at(block_name);
    std::string name = resource_name(program, field_interface, i);
    // A uniform block names every element of an array of structs; the table has the first.
    size_t element = 0;
    if (!storage && block.array) {
      const size_t open = name.find('[') + 1, close = name.find(']');
      element = std::stoul(name.substr(open, close - open));
      name.replace(open, close - open, "0");
    }
    const auto field = block.fields.find(name);
    ASSERT_NE(field, block.fields.end()) << block_name << " has no " << name << " in C++";
    const GLint offset = property(program, field_interface, i, GL_OFFSET) - GLint(element * block.bytes);
    const Field seen{offset, property(program, field_interface, i, GL_TYPE)};
    EXPECT_EQ(seen, field->second) << block_name << ": " << name << " of element " << element;
    if (storage && block.array) {
      const bool of_structs = name.find("].") != std::string::npos;
      const GLenum stride = of_structs ? GL_TOP_LEVEL_ARRAY_STRIDE : GL_ARRAY_STRIDE;
      EXPECT_EQ(size_t(property(program, field_interface, i, stride)), block.bytes) << block_name;
    }
    if (field->second.type == GL_FLOAT_MAT4) {
      EXPECT_EQ(property(program, field_interface, i, GL_MATRIX_STRIDE), 16) << name;
      EXPECT_EQ(property(program, field_interface, i, GL_IS_ROW_MAJOR), 0) << name;
    }
    met[block_name].insert(name);
  }
}

TEST(Layout, TheDriverTakesProgramsOfEveryDefineAndAgreesWithTheCompilerOnEveryField) {
  std::map<std::string, std::set<std::string>> met;
  const bool cached = !izb::gpu::CachedProgram({}).file().empty();
  for (const izb::gpu::ProgramSpec& spec : izb::test::chosen_programs()) {
    if (!izb::test::first_lacking(spec.extensions).empty()) continue;  // program_test says so
    SCOPED_TRACE(spec.label);
    try {
      const izb::gpu::Program made(spec);
      compare(made.name(), false, met);
      compare(made.name(), true, met);
      const izb::gpu::Program again(spec);
      EXPECT_TRUE(again.from_cache() || !cached);
      compare(again.name(), false, met);
      compare(again.name(), true, met);
    } catch (const izb::Error& e) {
      ADD_FAILURE() << "the driver does not take it: " << e.what();
    }
    if (HasFatalFailure()) return;
  }
  // Nothing of the table is left unseen.
  for (const auto& [name, block] : blocks) EXPECT_EQ(met[name].size(), block.fields.size()) << name;
}

}  // namespace
