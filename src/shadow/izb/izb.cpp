// SPDX-License-Identifier: MIT
#include "shadow/izb/izb.h"

#include "base/error.h"
#include "frame/spine.h"
#include "shadow/izb/table.h"
#include "shared/bindings.h"
#include "shared/lists.h"
#include "shared/pyramid.h"
#include "shared/sweep.h"

namespace izb {

namespace {

/// What is drawn in its scope is drawn only if samples passed in the query. A draw may throw: see between_draws.
struct WhereSamplesPassed {
  explicit WhereSamplesPassed(const gpu::Query& query) { glBeginConditionalRender(query.name(), GL_QUERY_WAIT); }
  ~WhereSamplesPassed() { glEndConditionalRender(); }
};

LightKind light_kind(const shared::LightFrame& light) {
  if (!shared::is_positional(light)) return LightKind::directional;
  return light.grid.z > 1 ? LightKind::cube : LightKind::positional;
}

}  // namespace

std::string Izb::missing(const gpu::Capabilities& capabilities) const {
  if (capabilities.subpixel_bits < 8)
    return fmt::format("the rasteriser has {} sub-pixel bits; the guard of conservative rasterisation needs 8",
                       capabilities.subpixel_bits);
  if (settings_.hardware())
    if (std::string lack = HardwareRaster::missing(capabilities, settings_.dilation()); !lack.empty()) return lack;
  // Instances, positions and indices, and the list of what is drawn.
  if (settings_.compute() && capabilities.max_vertex_storage_blocks < 4)
    return fmt::format("--raster compute reads 4 storage blocks in the vertex shader; this driver has {} there",
                       capabilities.max_vertex_storage_blocks);
  return settings_.grid > capabilities.max_texture_size
             ? fmt::format("--grid {} is beyond this driver's largest texture, {}", settings_.grid,
                           capabilities.max_texture_size)
             : "";
}

// What serves as it is stays: programs above all, which take seconds.
void Izb::resize(const FrameShape& shape) {
  const bool pool_serves = built_.pool() && settings_.pool() && shape_.width_px == shape.width_px &&
                           shape_.height_px == shape.height_px && built_.grid == settings_.grid &&
                           heads_.layers() == settings_.cascades * shape.faces;
  built_ = settings_;
  built_.pair_capacity = settings_.pairs(shape.width_px, shape.height_px);
  built_.geometry = shape.geometry.defines();
  const gpu::Capabilities capabilities = gpu::query_capabilities();
  shape_ = shape;
  const IzbSettings& s = built_;
  programs_.follow(s);
  if (s.hardware()) hardware_ = HardwareRaster(capabilities, s.dilation());
  resize_grids(s.cascades * shape.faces);
  if (!pool_serves) resize_nodes();
  if (!no_attributes_) no_attributes_ = gpu::VertexArray("none");
  if (!overflow_) overflow_ = gpu::Query("izb overflow", GL_ANY_SAMPLES_PASSED);
  const auto buffer = [](gpu::Buffer& kept, const char* label, size_t bytes) {
    if (kept.bytes() != gpu::buffer_bytes(bytes)) kept = gpu::Buffer(label, bytes);
  };
  buffer(counters_, "izb counters", sizeof(shared::Counters));
  buffer(pairs_, "izb unsure pairs", sizeof(shared::UnsurePair) * static_cast<size_t>(s.pair_capacity));
  if (s.pool())
    buffer(pool_counter_, "izb pool counter", sizeof(shared::PoolCounters));
  else
    pool_counter_ = gpu::Buffer();
  if (s.compute()) {
    buffer(listed_, "izb listed triangles", sizeof(shared::ListedTriangle) * shared::list_size);
    buffer(listed_counts_, "izb counts of listed triangles", sizeof(shared::ListedCounts));
  } else {
    listed_ = gpu::Buffer();
    listed_counts_ = gpu::Buffer();
  }
  if (s.lists_alpha())
    buffer(asked_, "izb pairs that ask alpha",
           sizeof(shared::UnsurePair) * static_cast<size_t>(s.asked_pairs(shape.width_px, shape.height_px)));
  else
    asked_ = gpu::Buffer();
  std::vector<uint32_t> words;
  if (s.table()) words = make_visibility_table(samples(), s.table_side());
  if (words == table_words_) return;
  table_ = words.empty() ? gpu::BufferTexture() : gpu::BufferTexture("visibility look-up table", words);
  table_words_ = std::move(words);
}

void Izb::resize_grids(int layers) {
  const IzbSettings& s = built_;
  if (heads_.become_array("izb heads", GL_R32UI, s.grid, s.grid, layers) || s.zcull != static_cast<bool>(furthest_) ||
      (s.zcull || s.occluders) != static_cast<bool>(depth_)) {
    light_framebuffer_ = gpu::Framebuffer();
    furthest_ = gpu::Texture();
    depth_ = gpu::Texture();
    pyramid_ = gpu::Texture();
  }
  if (s.zcull && !furthest_) furthest_ = gpu::Texture::array("izb furthest", GL_R32UI, s.grid, s.grid, layers);
  if ((s.zcull || s.occluders) && !depth_)
    depth_ = gpu::Texture::array("izb z-cull", GL_DEPTH_COMPONENT16, s.grid, s.grid, layers);
  if (!s.pyramid()) {
    pyramid_ = gpu::Texture();
  } else if (!pyramid_) {
    const int side = shared::pyramid_side(s.grid, 0);
    pyramid_ = gpu::Texture::array("izb z-cull pyramid", GL_R32UI, side + shared::pyramid_side(s.grid, 1),
                                   shared::pyramid_height(s.grid), layers);
  }
  if (!light_framebuffer_)
    light_framebuffer_ = depth_ ? gpu::Framebuffer("izb light space", {}, &depth_)
                                : gpu::Framebuffer("izb light space", s.grid, s.grid, layers);
}

void Izb::resize_nodes() {
  if (built_.pool())
    nodes_.become("izb nodes", GL_RG32UI, shared::pool_width, 1);
  else if (built_.many_samples())
    nodes_.become_array("izb nodes", GL_R32UI, shape_.width_px, shape_.height_px, built_.slots());
  else
    nodes_.become("izb nodes", GL_RG32UI, shape_.width_px, shape_.height_px);
}

void Izb::render(const FrameInputs& in, Visibility& out, gpu::StageTimers& timers) {
  programs_.prepare(light_kind(in.light), in.masked_casters);
  if (built_.occluders) {
    const gpu::StageTimers::Scope scope(timers, occluders_name);
    occlude(in);
  }
  {
    const gpu::StageTimers::Scope scope(timers, name(Stage::build));
    build(in, &out);
  }
  if (built_.zcull) {
    const gpu::StageTimers::Scope scope(timers, name(Stage::zcull));
    zcull(layers_of(in));
    if (built_.pyramid()) pyramid(layers_of(in));
  }
  const gpu::StageTimers::Scope scope(timers, name(Stage::visibility));
  visibility(in, out, {IzbProgram::visibility, built_.zcull});
}

// Casters with an alpha mask may have holes.
void Izb::occlude(const FrameInputs& in) {
  glBindFramebuffer(GL_FRAMEBUFFER, light_framebuffer_.name());
  glViewport(0, 0, built_.grid, built_.grid);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  glDepthMask(GL_TRUE);
  glEnable(GL_DEPTH_CLAMP);
  const float furthest = 1.0f;
  glClearNamedFramebufferfv(light_framebuffer_.name(), GL_DEPTH, 0, &furthest);
  programs_[IzbProgram::occluders].use();
  const bool apart = in.masked_casters && built_.alpha_masks();
  const int layers = layers_of(in), pass_layers = built_.layers_a_pass(static_cast<int>(in.light.grid.z));
  for (int first = 0; first < layers; first += pass_layers) {
    if (layers > 1) glUniform2i(2, first, std::min(first + pass_layers, layers));
    in.draw_casters(apart ? Drawn::opaque : Drawn::all);
  }
  glDisable(GL_DEPTH_CLAMP);
  glDisable(GL_DEPTH_TEST);
}

// With the occluders' depths, what they hide is written into the mask, if there is one.
void Izb::build(const FrameInputs& in, Visibility* out) {
  if (built_.occluders) {
    glBindTextureUnit(UNIT_OCCLUDERS, depth_.name());
    if (out) out->mask.clear_uint(0);
    glBindImageTexture(IMAGE_MASK, out ? out->mask.name() : 0, 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_R32UI);
  }
  const int texels_a_quad = built_.pool() ? count_pool(in) : 0;
  heads_.clear_uint(shared::no_node);  // a second build over old heads would close the lists into rings
  glBindImageTexture(IMAGE_HEADS, heads_.name(), 0, GL_TRUE, 0, GL_READ_WRITE, GL_R32UI);
  glBindImageTexture(IMAGE_NODES, nodes_.name(), 0, GL_TRUE, 0, GL_WRITE_ONLY, nodes_.format());
  if (built_.zcull) {
    furthest_.clear_uint(0);
    glBindImageTexture(IMAGE_FURTHEST, furthest_.name(), 0, GL_TRUE, 0, GL_READ_WRITE, GL_R32UI);
  }
  programs_[IzbProgram::build].use();
  if (built_.many_samples() && !built_.pool()) {
    glUniform1i(0, built_.slots());
    if (built_.insertion == "approximate") glUniform1f(1, static_cast<float>(built_.dilation()));
  }
  for (int first = 0; first == 0 || first < texels_a_quad; first += shared::texels_a_dispatch) {
    if (built_.pool()) glUniform2i(0, first, first + shared::texels_a_dispatch);
    insert(in, programs_[IzbProgram::build]);
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT |
                    GL_TEXTURE_UPDATE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
  }
}

// Every pixel once, or with exact insertion around a light once for each face.
void Izb::insert(const FrameInputs& in, const gpu::Program& program) {
  const int faces = static_cast<int>(in.light.grid.z);
  const bool face_by_face = built_.pool() && faces > 1;
  program.use();
  for (int face = 0; face < (face_by_face ? faces : 1); ++face) {
    if (face_by_face) glUniform1i(2, face);
    program.dispatch(in.width_px, in.height_px, 16, 16);
    if (face_by_face) glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT);
  }
}

// Exact insertion is never truncated: the nodes are counted, and room is made where there is too little. Returns the
// texels of the micro-quad that touches most.
int Izb::count_pool(const FrameInputs& in) {
  pool_counter_.fill(0);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, BIND_POOL, pool_counter_.name());
  insert(in, programs_[IzbProgram::count_nodes]);
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  const shared::PoolCounters counted = pool_counter_.read<shared::PoolCounters>(1)[0];
  // Some more than counted: compilers may round two programs' sums in two ways.
  const auto with_spare = [](auto count) { return count + count / 64 + 64; };
  const uint64_t nodes = with_spare(counted.nodes + (uint64_t{counted.carries} << 32));
  if (nodes / shared::pool_width + 1 > shared::pool_width)
    fail("exact insertion needs {} nodes; {} is the most: take a smaller --grid or --size, or fewer --cascades", nodes,
         int64_t(shared::pool_width) * shared::pool_width - 1);
  const int rows = static_cast<int>(nodes / shared::pool_width) + 1;
  if (rows > nodes_.height_px()) grow_pool(rows);
  pool_counter_.fill(0);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  return static_cast<int>(with_spare(counted.largest_quad));
}

void Izb::zcull(int layers) {
  glViewport(0, 0, built_.grid, built_.grid);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_ALWAYS);
  glDepthMask(GL_TRUE);
  glBindTextureUnit(UNIT_FURTHEST, furthest_.name());
  glBindFramebuffer(GL_FRAMEBUFFER, light_framebuffer_.name());
  glBindVertexArray(no_attributes_.name());
  programs_[IzbProgram::zcull].use();
  glDrawArraysInstanced(GL_TRIANGLES, 0, 3, layers);
  glDisable(GL_DEPTH_TEST);
}

void Izb::pyramid(int layers) {
  glBindImageTexture(IMAGE_PYRAMID, pyramid_.name(), 0, GL_TRUE, 0, GL_READ_WRITE, GL_R32UI);
  for (int level = 0; level < shared::pyramid_levels; ++level) {
    const gpu::Program& p = programs_[level == 0 ? IzbProgram::pyramid_first : IzbProgram::pyramid];
    p.use();
    glUniform1i(0, level);
    const int side = shared::pyramid_side(built_.grid, level);
    p.dispatch(side, side, 16, 16, layers);
    glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT);
  }
}

void Izb::bind_lists(const Visibility& out) const {
  glBindTextureUnit(UNIT_HEADS, heads_.name());
  glBindTextureUnit(UNIT_NODES, nodes_.name());
  glBindImageTexture(IMAGE_HEADS, heads_.name(), 0, GL_TRUE, 0, GL_READ_WRITE, GL_R32UI);
  glBindImageTexture(IMAGE_NODES, nodes_.name(), 0, GL_TRUE, 0, GL_READ_WRITE, nodes_.format());
  glBindImageTexture(IMAGE_MASK, out.mask.name(), 0, GL_FALSE, 0, GL_READ_WRITE, GL_R32UI);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, BIND_COUNTERS, counters_.name());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, BIND_PAIRS, pairs_.name());
  if (furthest_) glBindTextureUnit(UNIT_FURTHEST, furthest_.name());
  if (pyramid_) glBindTextureUnit(UNIT_PYRAMID, pyramid_.name());
  if (table_) glBindTextureUnit(UNIT_TABLE, table_.name());
}

// The triangles as they are: a passthrough geometry shader makes no polygons and reaches one layer.
void Izb::draw_by_hardware(const FrameInputs& in, IzbProgram program, Drawn drawn) {
  programs_.get(program, drawn == Drawn::masked).use();
  hardware_.begin();
  for (const glm::vec2& shift : hardware_.shifts())
    for (int layer = 0; layer < layers_of(in); ++layer) {
      glUniform2f(4, shift.x, shift.y);
      if (layers_of(in) > 1) glUniform2i(2, layer, layer + 1);
      in.draw_casters(drawn);
    }
  hardware_.end();
}

// Every caster once for as many layers as one pass reaches. Of what hardware rasterises only the rest, that it does not
// surely cover.
void Izb::draw_by_footprint(const FrameInputs& in, IzbProgram program, Drawn drawn) {
  programs_.get(program, drawn == Drawn::masked).use();
  glUniform1f(1, static_cast<float>(built_.dilation()));
  if (built_.hardware()) glUniform1f(3, hardware_.square());
  const int layers = layers_of(in), pass_layers = built_.layers_a_pass(static_cast<int>(in.light.grid.z));
  for (int first = 0; first < layers; first += pass_layers) {
    if (layers > 1) glUniform2i(2, first, std::min(first + pass_layers, layers));
    in.draw_casters(drawn);
  }
}

// Opaque casters do not pay for what the masks of others take.
void Izb::draw(const FrameInputs& in, const Pass& pass) {
  if (pass.culled) {
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LESS);
    glDepthMask(GL_FALSE);
  }
  const bool apart = in.masked_casters && built_.alpha_masks();
  for (const Drawn drawn : apart ? std::vector{Drawn::opaque, Drawn::masked} : std::vector{Drawn::all}) {
    if (built_.compute()) {
      draw_by_compute(in, pass.program, drawn);
      continue;
    }
    if (built_.hardware()) draw_by_hardware(in, beside(pass.program).hardware, drawn);
    draw_by_footprint(in, pass.program, drawn);
  }
  glDisable(GL_DEPTH_TEST);
}

void Izb::reset_counters() {
  shared::Counters fresh{};
  fresh.asked_capacity = static_cast<uint32_t>(built_.asked_pairs(shape_.width_px, shape_.height_px));
  fresh.capacity = static_cast<uint32_t>(built_.pair_capacity);
  counters_.update(0, sizeof fresh, &fresh);
}

// The pairs that are listed, in double.
void Izb::settle(const FrameInputs& in) {
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
  const bool masks = in.masked_casters && knows_masks(IzbProgram::settle, built_);
  // A pair of a mask takes up to nine rounds of loops.
  programs_.get(IzbProgram::settle, masks).dispatch(masks ? 64 * 256 : 64 * 16, 1, 64, 1);
}

void Izb::visibility(const FrameInputs& in, Visibility& out, const Pass& pass) {
  reset_counters();
  if (!built_.occluders) out.mask.clear_uint(0);  // else `build` has begun it

  glBindFramebuffer(GL_FRAMEBUFFER, light_framebuffer_.name());
  glViewport(0, 0, built_.grid, built_.grid);
  bind_lists(out);
  // Casters between the light and the window count: no near plane.
  glEnable(GL_DEPTH_CLAMP);
  draw(in, pass);

  settle(in);

  glBindVertexArray(no_attributes_.name());
  glBeginQuery(GL_ANY_SAMPLES_PASSED, overflow_.name());
  programs_[IzbProgram::overflow].use();
  glDrawArrays(GL_POINTS, 0, 1);
  glEndQuery(GL_ANY_SAMPLES_PASSED);
  {
    const WhereSamplesPassed overflowed(overflow_);
    draw(in, {IzbProgram::visibility_in_double, pass.culled});
  }

  glDisable(GL_DEPTH_CLAMP);
  glDepthMask(GL_TRUE);
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
}

shared::Counters Izb::visibility_counted(const FrameInputs& in, Visibility& out, const Pass& pass) {
  restore_lists(in, &out);
  visibility(in, out, pass);
  return read_counters();
}

std::unique_ptr<Technique> make_izb() {
  return std::make_unique<Izb>();
}

}  // namespace izb
