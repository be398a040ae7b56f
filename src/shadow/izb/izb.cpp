// SPDX-License-Identifier: MIT
#include "shadow/izb/izb.h"

#include <algorithm>
#include <stdexcept>

#include "base/error.h"
#include "frame/spine.h"
#include "gpu/program.h"
#include "shadow/izb/settings.h"
#include "shadow/izb/table.h"
#include "shared/bindings.h"
#include "shared/lists.h"
#include "shared/pairs.h"
#include "shared/pyramid.h"

namespace izb {
namespace {

class Izb final : public Technique {
 public:
  TechniqueInfo info() const override {
    return {"izb", "irregular z-buffer, alias-free hard shadows",
            "C. Wyman, R. Hoetzlein, A. Lefohn: Frustum-Traced Raster Shadows, I3D 2015"};
  }

  OptionSet options() override { return settings_.options(); }
  std::vector<std::string> presets() const override { return IzbSettings::preset_names(); }
  void apply_preset(const std::string& name) override { settings_.apply(name); }

  std::string missing(const gpu::Capabilities& capabilities) const override {
    if (capabilities.subpixel_bits < 8)
      return fmt::format("the rasteriser has {} sub-pixel bits; the guard of conservative rasterisation needs 8",
                         capabilities.subpixel_bits);
    return settings_.grid > capabilities.max_texture_size
               ? fmt::format("--grid {} is beyond this driver's largest texture, {}", settings_.grid,
                             capabilities.max_texture_size)
               : "";
  }

  SamplePattern samples() const override { return settings_.sampling.samples(); }
  GridRequest grid() const override {
    return {settings_.grid, settings_.nl_cull, settings_.cascades, settings_.table() ? settings_.table_side() : 0};
  }

  void resize(int width_px, int height_px) override;
  void render(const FrameInputs& in, Visibility& out, gpu::StageTimers& timers) override;
  Counts count(const FrameInputs& in, Visibility& out) override;
  Counts memory() const override;
  std::vector<float> list_lengths() const override;
  std::vector<uint64_t> list_histogram() const override;
  std::vector<gpu::ProgramSpec> program_specs() const override { return izb_program_specs(); }

 private:
  /// How the casters are drawn.
  struct Pass {
    IzbProgram program;
    bool culled;
  };

  void build(const FrameInputs& in);
  void count_pool(const FrameInputs& in);
  void zcull();
  void pyramid();
  void visibility(const FrameInputs& in, Visibility& out, const Pass& pass);
  void bind_lists(const Visibility& out) const;
  void draw(const FrameInputs& in, const Pass& pass);
  shared::Counters visibility_counted(const FrameInputs& in, Visibility& out, const Pass& pass);

  const gpu::Program& program(IzbProgram p);
  template <typename Visit>
  void for_each_list(Visit&& visit) const;

  IzbSettings settings_, built_;  ///< as the options say; as the programs and textures were made
  int width_px_ = 0, height_px_ = 0;
  std::vector<gpu::Program> programs_;
  gpu::Texture heads_;     ///< light-space grids of head pointers, one a cascade
  gpu::Texture nodes_;     ///< screen-space grid of nodes, or the pool of exact insertion
  gpu::Texture furthest_;  ///< bits of the furthest node's depth
  gpu::Texture depth_;     ///< the same as a depth buffer
  gpu::Texture pyramid_;   ///< the same for squares of texels, see shared/pyramid.h
  gpu::Framebuffer light_framebuffer_;
  std::vector<gpu::Framebuffer> zcull_framebuffers_;
  gpu::VertexArray no_attributes_;
  gpu::Buffer counters_, pairs_, pool_counter_;
  gpu::BufferTexture table_;
  gpu::Query overflow_;
};

const gpu::Program& Izb::program(IzbProgram p) {
  gpu::Program& made = programs_[static_cast<size_t>(p)];
  if (!made) made = gpu::Program(izb_program_spec(p, built_));
  return made;
}

void Izb::resize(int width_px, int height_px) {
  built_ = settings_;
  const IzbSettings& s = built_;
  width_px_ = width_px, height_px_ = height_px;
  programs_.clear();
  programs_.resize(static_cast<size_t>(IzbProgram::count));
  heads_ = gpu::Texture::array("izb heads", GL_R32UI, s.grid, s.grid, s.cascades);
  if (s.pool())
    nodes_ = gpu::Texture("izb nodes", GL_RG32UI, shared::pool_width, 1);
  else if (s.many_samples())
    nodes_ = gpu::Texture::array("izb nodes", GL_R32UI, width_px, height_px, s.slots());
  else
    nodes_ = gpu::Texture("izb nodes", GL_RG32UI, width_px, height_px);
  furthest_ = gpu::Texture();
  depth_ = gpu::Texture();
  pyramid_ = gpu::Texture();
  zcull_framebuffers_.clear();
  if (s.zcull) {
    furthest_ = gpu::Texture::array("izb furthest", GL_R32UI, s.grid, s.grid, s.cascades);
    depth_ = gpu::Texture::array("izb z-cull", GL_DEPTH_COMPONENT16, s.grid, s.grid, s.cascades);
    for (int c = 0; c < s.cascades; ++c)
      zcull_framebuffers_.push_back(gpu::Framebuffer::depth_layer("izb z-cull", depth_, c));
  }
  if (s.pyramid()) {
    const int side = shared::pyramid_side(s.grid, 0);
    pyramid_ = gpu::Texture::array("izb z-cull pyramid", GL_R32UI, side + shared::pyramid_side(s.grid, 1),
                                   shared::pyramid_height(s.grid), s.cascades);
  }
  light_framebuffer_ = s.zcull ? gpu::Framebuffer("izb light space", {}, &depth_)
                               : gpu::Framebuffer("izb light space", s.grid, s.grid, s.cascades);
  no_attributes_ = gpu::VertexArray("none");
  counters_ = gpu::Buffer("izb counters", sizeof(shared::Counters));
  pairs_ = gpu::Buffer("izb unsure pairs", sizeof(shared::UnsurePair) * static_cast<size_t>(s.pair_capacity));
  pool_counter_ = gpu::Buffer("izb pool counter", sizeof(shared::PoolCounters));
  table_ = gpu::BufferTexture();
  if (s.table())
    table_ = gpu::BufferTexture("visibility look-up table", make_visibility_table(samples(), s.table_side()));
  overflow_ = gpu::Query("izb overflow", GL_ANY_SAMPLES_PASSED);
  for (int p = 0; p < static_cast<int>(IzbProgram::count); ++p)
    if (const IzbProgram each = static_cast<IzbProgram>(p); each != IzbProgram::visibility_counted &&
                                                            each != IzbProgram::visibility_counted_all &&
                                                            (each != IzbProgram::count_nodes || s.pool()))
      program(each);  // nothing is compiled within a frame
}

void Izb::render(const FrameInputs& in, Visibility& out, gpu::StageTimers& timers) {
  {
    const gpu::StageTimers::Scope scope(timers, name(Stage::build));
    build(in);
  }
  if (built_.zcull) {
    const gpu::StageTimers::Scope scope(timers, name(Stage::zcull));
    zcull();
    if (built_.pyramid()) pyramid();
  }
  const gpu::StageTimers::Scope scope(timers, name(Stage::visibility));
  visibility(in, out, {IzbProgram::visibility, built_.zcull});
}

void Izb::build(const FrameInputs& in) {
  if (built_.pool()) count_pool(in);
  heads_.clear_uint(shared::no_node);  // a second build over old heads would close the lists into rings
  glBindImageTexture(IMAGE_HEADS, heads_.name(), 0, GL_TRUE, 0, GL_READ_WRITE, GL_R32UI);
  glBindImageTexture(IMAGE_NODES, nodes_.name(), 0, GL_TRUE, 0, GL_WRITE_ONLY, nodes_.format());
  if (built_.zcull) {
    furthest_.clear_uint(0);
    glBindImageTexture(IMAGE_FURTHEST, furthest_.name(), 0, GL_TRUE, 0, GL_READ_WRITE, GL_R32UI);
  }
  program(IzbProgram::build).use();
  if (built_.many_samples() && !built_.pool()) glUniform1i(0, built_.slots());
  program(IzbProgram::build).dispatch(in.width_px, in.height_px, 16, 16);
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
}

// Exact insertion is never truncated: the nodes are counted, and room is made where there is too little.
void Izb::count_pool(const FrameInputs& in) {
  pool_counter_.fill(0);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, BIND_POOL, pool_counter_.name());
  program(IzbProgram::count_nodes).dispatch(in.width_px, in.height_px, 16, 16);
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  const shared::PoolCounters counted = pool_counter_.read<shared::PoolCounters>(1)[0];
  const uint32_t nodes = counted.nodes, largest_quad = counted.largest_quad;
  if (largest_quad > shared::most_texels_a_quad)
    fail(
        "exact insertion: one micro-quad touches {} texels of the light-space grid, and {} is the most: take a smaller "
        "--grid or fewer --cascades",
        largest_quad, shared::most_texels_a_quad);
  const int rows = static_cast<int>(nodes / shared::pool_width) + 1;
  if (rows > shared::pool_width)
    fail("exact insertion needs {} nodes; {} is the most: take a smaller --grid or --size", nodes,
         int64_t(shared::pool_width) * shared::pool_width - 1);
  if (rows > nodes_.height_px())
    nodes_ = gpu::Texture("izb nodes", GL_RG32UI, shared::pool_width, std::min(rows + rows / 8, shared::pool_width));
  pool_counter_.fill(0);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

void Izb::zcull() {
  glViewport(0, 0, built_.grid, built_.grid);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_ALWAYS);
  glDepthMask(GL_TRUE);
  glBindTextureUnit(UNIT_FURTHEST, furthest_.name());
  glBindVertexArray(no_attributes_.name());
  program(IzbProgram::zcull).use();
  for (int cascade = 0; cascade < built_.cascades; ++cascade) {
    glBindFramebuffer(GL_FRAMEBUFFER, zcull_framebuffers_[cascade].name());
    glUniform1i(0, cascade);
    glDrawArrays(GL_TRIANGLES, 0, 3);
  }
  glDisable(GL_DEPTH_TEST);
}

void Izb::pyramid() {
  glBindImageTexture(IMAGE_PYRAMID, pyramid_.name(), 0, GL_TRUE, 0, GL_READ_WRITE, GL_R32UI);
  for (int level = 0; level < shared::pyramid_levels; ++level) {
    const gpu::Program& p = program(level == 0 ? IzbProgram::pyramid_first : IzbProgram::pyramid);
    p.use();
    glUniform1i(0, level);
    const int side = shared::pyramid_side(built_.grid, level);
    p.dispatch(side, side, 16, 16, built_.cascades);
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
  if (pyramid_) glBindTextureUnit(UNIT_PYRAMID, pyramid_.name());
  if (table_) glBindTextureUnit(UNIT_TABLE, table_.name());
}

// Every caster once for all cascades, or once for each.
void Izb::draw(const FrameInputs& in, const Pass& pass) {
  if (pass.culled) {
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LESS);
    glDepthMask(GL_FALSE);
  }
  program(pass.program).use();
  glUniform1f(1, static_cast<float>(built_.dilation()));
  const int layers = built_.layers_a_pass();
  for (int first = 0; first < built_.cascades; first += layers) {
    if (built_.cascades > 1) glUniform2i(2, first, first + layers);
    in.draw_casters();
  }
  glDisable(GL_DEPTH_TEST);
}

void Izb::visibility(const FrameInputs& in, Visibility& out, const Pass& pass) {
  shared::Counters fresh{};
  fresh.capacity = static_cast<uint32_t>(built_.pair_capacity);
  counters_.update(0, sizeof fresh, &fresh);
  out.mask.clear_uint(0);

  glBindFramebuffer(GL_FRAMEBUFFER, light_framebuffer_.name());
  glViewport(0, 0, built_.grid, built_.grid);
  bind_lists(out);
  // Casters between the light and the window count: no near plane.
  glEnable(GL_DEPTH_CLAMP);
  draw(in, pass);

  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
  program(IzbProgram::settle).dispatch(64 * 16, 1, 64, 1);

  glBindVertexArray(no_attributes_.name());
  glBeginQuery(GL_ANY_SAMPLES_PASSED, overflow_.name());
  program(IzbProgram::overflow).use();
  glDrawArrays(GL_POINTS, 0, 1);
  glEndQuery(GL_ANY_SAMPLES_PASSED);
  glBeginConditionalRender(overflow_.name(), GL_QUERY_WAIT);
  draw(in, {IzbProgram::visibility_in_double, pass.culled});
  glEndConditionalRender();

  glDisable(GL_DEPTH_CLAMP);
  glDepthMask(GL_TRUE);
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
}

shared::Counters Izb::visibility_counted(const FrameInputs& in, Visibility& out, const Pass& pass) {
  // Removal leaves shorter lists behind.
  if (built_.removal) build(in);
  visibility(in, out, pass);
  return counters_.read<shared::Counters>(1)[0];
}

Counts Izb::count(const FrameInputs& in, Visibility& out) {
  const shared::Counters all = visibility_counted(in, out, {IzbProgram::visibility_counted_all, false});
  const shared::Counters culled =
      built_.zcull ? visibility_counted(in, out, {IzbProgram::visibility_counted, true}) : all;
  if (built_.removal) build(in);
  const std::vector<uint64_t> histogram = list_histogram();
  uint64_t nodes = 0, lists = 0;
  for (size_t length = 1; length < histogram.size(); ++length) {
    nodes += histogram[length] * length;
    lists += histogram[length];
  }
  return {{"triangles", all.triangles},
          {"triangles_after_zcull", culled.triangles},
          {"fragments", all.fragments},
          {"fragments_after_zcull", culled.fragments},
          {"visibility_tests", culled.visibility_tests},
          {"nodes", nodes},
          {"lists", lists},
          {"longest_list", histogram.empty() ? 0 : histogram.size() - 1},
          {"pairs_in_double", culled.pairs},
          {"nodes_removed", culled.removed},
          {"masks_unchanged", culled.unchanged}};
}

// Calls visit(pixels of one list) for each list. Throws std::logic_error where a node stands in two lists.
template <typename Visit>
void Izb::for_each_list(Visit&& visit) const {
  const std::vector<uint32_t> heads = heads_.read_uint();
  const bool pairs = nodes_.format() == GL_RG32UI;  // next pointer and another word; else the pointer alone
  const size_t words = pairs ? 2 : 1;
  std::vector<uint32_t> nodes(size_t(nodes_.width_px()) * nodes_.height_px() * nodes_.layers() * words);
  nodes_.read_bytes(pairs ? GL_RG_INTEGER : GL_RED_INTEGER, GL_UNSIGNED_INT, nodes.size() * sizeof(uint32_t),
                    nodes.data());
  const auto at = [&](uint32_t node) -> size_t {
    if (built_.pool()) return node;
    const glm::ivec2 px = shared::pixel_from_node(node);
    const int slot = built_.many_samples() ? shared::slot_from_node(node) : 0;
    return (size_t(slot) * nodes_.height_px() + px.y) * nodes_.width_px() + px.x;
  };
  std::vector<bool> seen(nodes.size() / words);
  std::vector<size_t> pixels;
  for (const uint32_t head : heads) {
    pixels.clear();
    for (uint32_t node = head; node != shared::no_node; node = nodes[words * at(node)]) {
      if (seen[at(node)]) throw std::logic_error("an IZB node stands in two lists");
      seen[at(node)] = true;
      const glm::ivec2 px = shared::pixel_from_node(built_.pool() ? nodes[words * at(node) + 1] : node);
      pixels.push_back(size_t(px.y) * width_px_ + px.x);
    }
    visit(pixels);
  }
}

std::vector<float> Izb::list_lengths() const {
  std::vector<float> lengths(size_t(width_px_) * height_px_, 0.0f);
  for_each_list([&](const std::vector<size_t>& pixels) {
    for (const size_t pixel : pixels) lengths[pixel] = std::max(lengths[pixel], static_cast<float>(pixels.size()));
  });
  return lengths;
}

std::vector<uint64_t> Izb::list_histogram() const {
  std::vector<uint64_t> histogram;
  for_each_list([&](const std::vector<size_t>& pixels) {
    if (histogram.size() <= pixels.size()) histogram.resize(pixels.size() + 1);
    ++histogram[pixels.size()];
  });
  return histogram;
}

Counts Izb::memory() const {
  return {{"heads", heads_.bytes()},       {"nodes", nodes_.bytes()},
          {"furthest", furthest_.bytes()}, {"zcull", depth_.bytes() + pyramid_.bytes()},
          {"table", table_.bytes()},       {"pairs", pairs_.bytes() + counters_.bytes()}};
}

}  // namespace

std::unique_ptr<Technique> make_izb() {
  return std::make_unique<Izb>();
}

}  // namespace izb
