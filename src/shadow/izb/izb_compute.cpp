// SPDX-License-Identifier: MIT
// --raster compute: triangles are swept by a compute shader, large ones tile by tile (shared/sweep.h).
#include <algorithm>
#include <cstddef>

#include "base/error.h"
#include "shadow/izb/izb.h"
#include "shared/bindings.h"
#include "shared/sweep.h"

namespace izb {

namespace {

/// What lists the tiles of large triangles before a variant of `visibility`.
IzbProgram tiles_of(IzbProgram visibility) {
  switch (visibility) {
    case IzbProgram::visibility:
    case IzbProgram::visibility_stored:
      return IzbProgram::tiles;
    case IzbProgram::visibility_counted_all:
      return IzbProgram::tiles_counted_all;
    default:
      return IzbProgram::tiles_counted;
  }
}

}  // namespace

// Listed as to be swept or to be drawn; swept, part by part; drawn.
void Izb::draw_by_compute(const FrameInputs& in, IzbProgram program, Drawn drawn) {
  if (!in.for_casters)
    fail(
        "--raster compute takes the triangles by their numbers, but FrameInputs::for_casters is empty: give it, or "
        "take --raster gs");
  if (program == IzbProgram::visibility_in_double) return draw_in_double(in, drawn);
  const int layers = layers_of(in), instances = static_cast<int>(in.first_triangle->size());
  const bool masked = drawn == Drawn::masked;
  const bool culled = program != IzbProgram::visibility_counted_all;
  const gpu::Program& list = programs_[culled ? IzbProgram::list : IzbProgram::list_all];
  const gpu::Program& tiles = programs_[tiles_of(program)];
  const gpu::Program &sweep = programs_.get(beside(program).sweep, masked), &rest = programs_.get(program, masked);
  const gpu::Program* alpha = nullptr;
  if (masked && asked_) {
    alpha =
        &programs_.get(tiles_of(program) == IzbProgram::tiles ? IzbProgram::alpha : IzbProgram::alpha_counted, true);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, BIND_ASKED, asked_.name());
  }
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, BIND_LISTED, listed_.name());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, BIND_LISTED_COUNTS, listed_counts_.name());
  glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, listed_counts_.name());
  glBindBuffer(GL_DRAW_INDIRECT_BUFFER, listed_counts_.name());
  glBindVertexArray(no_attributes_.name());
  constexpr GLbitfield stored = GL_SHADER_STORAGE_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT;
  in.for_casters(drawn, static_cast<uint32_t>(shared::most_listed / layers), [&](uint32_t first, uint32_t end) {
    shared::ListedCounts none{};
    for (glm::uvec4& part : none.part) part = {0, 1, 1, 0};
    none.rows = {0, 1, 1, 0};
    none.room = {0, built_.rows_room, (end - first) * static_cast<uint32_t>(layers) + built_.tiles_room, 0};
    none.draw_instances = 1;
    listed_counts_.update(0, sizeof none, &none);
    glMemoryBarrier(stored);  // what the draw before has read is written again
    list.use();
    glUniform2ui(0, first, end);
    glUniform1f(1, static_cast<float>(built_.dilation()));
    glUniform1i(2, instances);
    glUniform1i(3, built_.compute_texels);
    const int count = static_cast<int>(end - first);
    list.dispatch(std::min(count, shared::list_width), (count - 1) / shared::list_width + 1, 64, 1, layers);
    glMemoryBarrier(stored | GL_COMMAND_BARRIER_BIT);
    tiles.use();
    glUniform1f(1, static_cast<float>(built_.dilation()));
    glDispatchComputeIndirect(offsetof(shared::ListedCounts, rows));
    glMemoryBarrier(stored | GL_COMMAND_BARRIER_BIT);
    sweep.use();
    glUniform1f(1, static_cast<float>(built_.dilation()));
    const int parts = built_.compute_rounds > 0 ? shared::sweep_parts : 1;
    for (int part = 0; part < parts; ++part) {
      glUniform1i(2, part);
      glUniform1i(3, shared::part_rounds(part, parts, built_.compute_rounds));
      glUniform1i(4, part == parts - 1);
      glDispatchComputeIndirect(static_cast<GLintptr>(sizeof none.part[0]) * part);
      glMemoryBarrier(stored | GL_COMMAND_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
      if (alpha) ask_alpha(*alpha);
      if (alpha) sweep.use();
    }
    rest.use();
    glUniform1f(1, static_cast<float>(built_.dilation()));
    glDrawArraysIndirect(GL_TRIANGLES, reinterpret_cast<const void*>(offsetof(shared::ListedCounts, vertices)));
  });
}

// Of what a dispatch has listed, so that the next one may find pixels in full shadow.
void Izb::ask_alpha(const gpu::Program& program) {
  program.dispatch(64 * 256, 1, 64, 1);  // as many as settle()
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
  const uint32_t none = 0;
  counters_.update(offsetof(shared::Counters, asked), sizeof none, &none);
}

// Where the list of unsure pairs was too short: all of them, without the sweep.
void Izb::draw_in_double(const FrameInputs& in, Drawn drawn) {
  programs_.get(IzbProgram::visibility_in_double, drawn == Drawn::masked).use();
  glUniform1f(1, static_cast<float>(built_.dilation()));
  glUniform1i(4, static_cast<int>(in.first_triangle->size()));
  glBindVertexArray(no_attributes_.name());
  const int layers = layers_of(in);
  in.for_casters(drawn, largest_part_triangles / static_cast<uint32_t>(layers), [&](uint32_t first, uint32_t end) {
    glUniform1ui(5, first);
    glDrawArraysInstanced(GL_TRIANGLES, 0, static_cast<GLsizei>(3 * (end - first)), layers);
  });
}

}  // namespace izb
