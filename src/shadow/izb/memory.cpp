// SPDX-License-Identifier: MIT
// GPU memory of the technique: what its options will take, what it has taken, and the pool that only a frame can size.
#include <algorithm>

#include "shadow/izb/izb.h"
#include "shared/lists.h"
#include "shared/pyramid.h"
#include "shared/sweep.h"
#include "shared/table.h"

namespace izb {
namespace {

/// Exact insertion's pool of so many rows. Fewer, larger texels of the grid take fewer nodes.
gpu::Planned planned_pool(int rows) {
  return gpu::planned_texture("nodes", GL_RG32UI, shared::pool_width, rows, {"--size", "--grid"});
}

}  // namespace

gpu::Plan Izb::memory_needed(const FrameShape& shape) const {
  const int width_px = shape.width_px, height_px = shape.height_px, layers = settings_.cascades * shape.faces;
  const IzbSettings& s = settings_;
  const auto grids = [&](const char* part, GLenum format) {
    return gpu::planned_texture(part, format, s.grid, s.grid, {"--grid", "--cascades"}, layers);
  };
  gpu::Plan plan{grids("heads", GL_R32UI)};
  if (s.pool())
    plan.push_back(planned_pool(1));
  else if (s.many_samples())
    plan.push_back(gpu::planned_texture("nodes", GL_R32UI, width_px, height_px, {"--size", "--nodes"}, s.slots()));
  else
    plan.push_back(gpu::planned_texture("nodes", GL_RG32UI, width_px, height_px, {"--size"}));
  if (s.zcull) plan.push_back(grids("furthest", GL_R32UI));
  if (s.zcull || s.occluders) plan.push_back(grids("zcull", GL_DEPTH_COMPONENT16));
  if (s.pyramid())
    plan.push_back(gpu::planned_texture("zcull", GL_R32UI,
                                        shared::pyramid_side(s.grid, 0) + shared::pyramid_side(s.grid, 1),
                                        shared::pyramid_height(s.grid), {"--grid", "--cascades"}, layers));
  using Kind = gpu::Planned::Kind;
  const auto buffer = [&](const char* part, Kind kind, uint64_t bytes, std::vector<std::string> reduce = {}) {
    plan.push_back(gpu::planned_buffer(part, kind, bytes, std::move(reduce)));
  };
  if (s.table())
    plan.push_back(gpu::planned_buffer_texture(
        "table", GL_R32UI, uint64_t(s.table_side()) * uint64_t(shared::table_columns(s.table_side())), {}));
  buffer("pairs", Kind::storage_buffer,
         sizeof(shared::UnsurePair) * static_cast<uint64_t>(s.pairs(width_px, height_px)), {"--pairs"});
  buffer("pairs", Kind::storage_buffer, sizeof(shared::Counters));
  if (s.pool()) buffer("pairs", Kind::storage_buffer, sizeof(shared::PoolCounters));
  if (s.compute()) {
    buffer("listed", Kind::storage_buffer, sizeof(shared::ListedTriangle) * shared::list_size);
    buffer("listed", Kind::storage_buffer, sizeof(shared::ListedCounts));
  }
  if (s.lists_alpha())
    buffer("asked", Kind::storage_buffer,
           sizeof(shared::UnsurePair) * static_cast<uint64_t>(s.asked_pairs(width_px, height_px)), {"--pairs"});
  return plan;
}

Counts Izb::memory() const {
  return {{"heads", heads_.bytes()},
          {"nodes", nodes_.bytes()},
          {"furthest", furthest_.bytes()},
          {"zcull", depth_.bytes() + pyramid_.bytes()},
          {"table", table_.bytes()},
          {"pairs", pairs_.bytes() + counters_.bytes() + pool_counter_.bytes()},
          {"listed", listed_.bytes() + listed_counts_.bytes()},
          {"asked", asked_.bytes()}};
}

// Known only now, since the receivers' places in the grid decide it. An eighth more, so that a moving camera does not
// grow it in every frame.
void Izb::grow_pool(int rows) {
  const gpu::Capabilities capabilities = gpu::query_capabilities();
  const gpu::Room room = gpu::memory_room(capabilities, nodes_.bytes());
  gpu::expect_room({{"exact insertion", {planned_pool(rows)}}}, room, capabilities);
  const int more = std::min(rows + rows / 8, shared::pool_width);
  const bool fits = !room.bytes || gpu::bytes_of({planned_pool(more)}) <= *room.bytes;
  nodes_ = gpu::Texture();  // the old one's room is part of that
  nodes_ = gpu::Texture("izb nodes", GL_RG32UI, shared::pool_width, fits ? more : rows);
}

}  // namespace izb
