// SPDX-License-Identifier: MIT
#include "shadow/izb/izb.h"

#include <algorithm>
#include <bit>
#include <stdexcept>

#include "base/error.h"
#include "frame/spine.h"
#include "gpu/program.h"
#include "shared/bindings.h"
#include "shared/lists.h"
#include "shared/pairs.h"
#include "shared/pyramid.h"

namespace izb {
namespace {

const std::string folder = "shadow/izb/";

gpu::ProgramSpec visibility_spec(const std::string& label, const gpu::Defines& defines) {
  return {label,
          {folder + "5_visibility.vert.glsl", folder + "5_visibility.geom.glsl", folder + "5_visibility.frag.glsl"},
          defines};
}

gpu::Defines define_if(bool on, const char* name) {
  return on ? gpu::Defines{{name, "1"}} : gpu::Defines{};
}

class Izb final : public Technique {
 public:
  TechniqueInfo info() const override {
    return {"izb", "irregular z-buffer, exact hard shadows",
            "C. Wyman, R. Hoetzlein, A. Lefohn: Frustum-Traced Raster Shadows, I3D 2015"};
  }

  OptionSet options() override {
    OptionSet set;
    sampling_.declare(set);
    set.integer("grid", grid_, 16, 16384, "texels", "side of the light-space grid of lists (6.3)");
    set.flag("zcull", zcull_, "light-space culling prepass and early z (5.4)");
    set.flag("zcull-pyramid", zcull_pyramid_,
             "with z-cull, end triangles that no receiver lies behind in the geometry shader, by a pyramid of furthest "
             "depths");
    set.flag("nl-cull", nl_cull_, "leave pixels with N.L <= 0 out of the lists (6.5)");
    set.integer("pairs", pair_capacity_, 0, 1 << 22, "pairs",
                "room for triangle-pixel pairs that single precision cannot decide; when it is exceeded every pair of "
                "the frame is decided in double");
    return set;
  }

  std::string missing(const gpu::Capabilities& capabilities) const override {
    if (capabilities.subpixel_bits < 8)
      return fmt::format("the rasteriser has {} sub-pixel bits; the guard of conservative rasterisation needs 8",
                         capabilities.subpixel_bits);
    return grid_ > capabilities.max_texture_size ? fmt::format("--grid {} is beyond this driver's largest texture, {}",
                                                               grid_, capabilities.max_texture_size)
                                                 : "";
  }

  SamplePattern samples() const override { return sampling_.samples(); }
  GridRequest grid() const override { return {grid_, nl_cull_}; }

  void resize(int width_px, int height_px) override;
  void render(const FrameInputs& in, Visibility& out, gpu::StageTimers& timers) override;
  Counts count(const FrameInputs& in, Visibility& out) override;
  Counts memory() const override;
  std::vector<float> list_lengths() const override;
  std::vector<gpu::ProgramSpec> program_specs() const override;

 private:
  void build(const FrameInputs& in);
  void zcull();
  void pyramid();
  void visibility(const FrameInputs& in, Visibility& out, const gpu::Program& program, bool culled);
  shared::Counters visibility_counted(const FrameInputs& in, Visibility& out, const gpu::Program& program, bool culled);

  SampleOptions sampling_{"1", "hammersley"};
  int grid_ = 2048;
  bool zcull_ = true, zcull_pyramid_ = true, nl_cull_ = true;
  int pair_capacity_ = 1 << 17;

  std::vector<glm::uvec2> read_nodes() const;
  bool pyramid_on() const { return zcull_ && zcull_pyramid_; }

  gpu::Program build_program_, zcull_program_, pyramid_first_program_, pyramid_program_, visibility_program_,
      counting_program_, counting_all_program_, settle_program_, overflow_program_, double_program_;
  gpu::Texture heads_;     ///< light-space grid of head pointers
  gpu::Texture nodes_;     ///< screen-space grid of nodes: next pointer, bits of the eye distance
  gpu::Texture furthest_;  ///< bits of the furthest node's depth
  gpu::Texture depth_;     ///< the same as a depth buffer
  gpu::Texture pyramid_;   ///< the same for squares of texels, see shared/pyramid.h
  gpu::Framebuffer light_framebuffer_;
  gpu::VertexArray no_attributes_;
  gpu::Buffer counters_, pairs_;
  gpu::Query overflow_;
};

std::vector<gpu::ProgramSpec> Izb::program_specs() const {
  std::vector<gpu::ProgramSpec> specs;
  for (const bool zcull : {true, false})
    specs.push_back({"izb build", {folder + "3_build.comp.glsl"}, define_if(zcull, "ZCULL")});
  specs.push_back({"izb zcull", {folder + "4_zcull.vert.glsl", folder + "4_zcull.frag.glsl"}, {}});
  for (const bool first : {true, false})
    specs.push_back({"izb zcull pyramid", {folder + "4_zcull_pyramid.comp.glsl"}, define_if(first, "FIRST_LEVEL")});
  for (const bool pyramid : {true, false})
    for (const char* variant : {"", "COUNT", "IN_DOUBLE"}) {
      gpu::Defines defines = define_if(pyramid, "PYRAMID");
      if (*variant) defines[variant] = "1";
      specs.push_back(visibility_spec(fmt::format("izb visibility {}", variant), defines));
    }
  specs.push_back({"izb visibility settle", {folder + "5_visibility_settle.comp.glsl"}, {}});
  specs.push_back({"izb visibility overflow",
                   {folder + "5_visibility_overflow.vert.glsl", folder + "5_visibility_overflow.frag.glsl"},
                   {}});
  return specs;
}

void Izb::resize(int width_px, int height_px) {
  const std::vector<gpu::ProgramSpec> specs = program_specs();
  const size_t visibility = pyramid_on() ? 5 : 8;
  build_program_ = gpu::Program(specs[zcull_ ? 0 : 1]);
  zcull_program_ = gpu::Program(specs[2]);
  pyramid_first_program_ = gpu::Program(specs[3]);
  pyramid_program_ = gpu::Program(specs[4]);
  visibility_program_ = gpu::Program(specs[visibility]);
  counting_program_ = gpu::Program(specs[visibility + 1]);
  double_program_ = gpu::Program(specs[visibility + 2]);
  counting_all_program_ = gpu::Program(specs[9]);
  settle_program_ = gpu::Program(specs[11]);
  overflow_program_ = gpu::Program(specs[12]);

  heads_ = gpu::Texture("izb heads", GL_R32UI, grid_, grid_);
  nodes_ = gpu::Texture("izb nodes", GL_RG32UI, width_px, height_px);
  furthest_ = zcull_ ? gpu::Texture("izb furthest", GL_R32UI, grid_, grid_) : gpu::Texture();
  depth_ = zcull_ ? gpu::Texture("izb z-cull", GL_DEPTH_COMPONENT16, grid_, grid_) : gpu::Texture();
  pyramid_ = gpu::Texture();
  if (pyramid_on()) {
    const int side = shared::pyramid_side(grid_, 0);
    pyramid_ = gpu::Texture("izb z-cull pyramid", GL_R32UI, side + shared::pyramid_side(grid_, 1), shared::pyramid_height(grid_));
  }
  light_framebuffer_ =
      zcull_ ? gpu::Framebuffer("izb light space", {}, &depth_) : gpu::Framebuffer("izb light space", grid_, grid_);
  no_attributes_ = gpu::VertexArray("none");
  counters_ = gpu::Buffer("izb counters", sizeof(shared::Counters));
  pairs_ = gpu::Buffer("izb unsure pairs", sizeof(shared::UnsurePair) * static_cast<size_t>(pair_capacity_));
  overflow_ = gpu::Query("izb overflow", GL_ANY_SAMPLES_PASSED);
}

void Izb::render(const FrameInputs& in, Visibility& out, gpu::StageTimers& timers) {
  {
    const gpu::StageTimers::Scope scope(timers, name(Stage::build));
    build(in);
  }
  if (zcull_) {
    const gpu::StageTimers::Scope scope(timers, name(Stage::zcull));
    zcull();
    if (zcull_pyramid_) pyramid();
  }
  const gpu::StageTimers::Scope scope(timers, name(Stage::visibility));
  visibility(in, out, visibility_program_, zcull_);
}

void Izb::build(const FrameInputs& in) {
  heads_.clear_uint(shared::no_node);  // a second build over old heads would close the lists into rings
  glBindImageTexture(IMAGE_HEADS, heads_.name(), 0, GL_FALSE, 0, GL_READ_WRITE, GL_R32UI);
  glBindImageTexture(IMAGE_NODES, nodes_.name(), 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_RG32UI);
  if (zcull_) {
    furthest_.clear_uint(0);
    glBindImageTexture(IMAGE_FURTHEST, furthest_.name(), 0, GL_FALSE, 0, GL_READ_WRITE, GL_R32UI);
  }
  build_program_.dispatch(in.width_px, in.height_px, 16, 16);
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
}

void Izb::zcull() {
  glBindFramebuffer(GL_FRAMEBUFFER, light_framebuffer_.name());
  glViewport(0, 0, grid_, grid_);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_ALWAYS);
  glDepthMask(GL_TRUE);
  glBindTextureUnit(UNIT_FURTHEST, furthest_.name());
  glBindVertexArray(no_attributes_.name());
  zcull_program_.use();
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glDisable(GL_DEPTH_TEST);
}

void Izb::pyramid() {
  glBindImageTexture(IMAGE_PYRAMID, pyramid_.name(), 0, GL_FALSE, 0, GL_READ_WRITE, GL_R32UI);
  for (int level = 0; level < shared::pyramid_levels; ++level) {
    const gpu::Program& program = level == 0 ? pyramid_first_program_ : pyramid_program_;
    program.use();
    glUniform1i(0, level);
    const int side = shared::pyramid_side(grid_, level);
    program.dispatch(side, side, 16, 16);
    glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT);
  }
}

void Izb::visibility(const FrameInputs& in, Visibility& out, const gpu::Program& program, bool culled) {
  shared::Counters fresh{};
  fresh.capacity = static_cast<uint32_t>(pair_capacity_);
  counters_.update(0, sizeof fresh, &fresh);
  out.mask.clear_uint(0);

  glBindFramebuffer(GL_FRAMEBUFFER, light_framebuffer_.name());
  glViewport(0, 0, grid_, grid_);
  glBindTextureUnit(UNIT_HEADS, heads_.name());
  glBindTextureUnit(UNIT_NODES, nodes_.name());
  glBindImageTexture(IMAGE_MASK, out.mask.name(), 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_R32UI);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, BIND_COUNTERS, counters_.name());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, BIND_PAIRS, pairs_.name());

  if (pyramid_on()) glBindTextureUnit(UNIT_PYRAMID, pyramid_.name());

  // Casters between the light and the window count: no near plane.
  glEnable(GL_DEPTH_CLAMP);
  if (culled) {
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LESS);
    glDepthMask(GL_FALSE);
  }
  program.use();
  in.draw_casters();

  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
  settle_program_.dispatch(64 * 16, 1, 64, 1);

  glDisable(GL_DEPTH_TEST);
  glBindVertexArray(no_attributes_.name());
  glBeginQuery(GL_ANY_SAMPLES_PASSED, overflow_.name());
  overflow_program_.use();
  glDrawArrays(GL_POINTS, 0, 1);
  glEndQuery(GL_ANY_SAMPLES_PASSED);
  if (culled) glEnable(GL_DEPTH_TEST);
  glBeginConditionalRender(overflow_.name(), GL_QUERY_WAIT);
  double_program_.use();
  in.draw_casters();
  glEndConditionalRender();

  glDisable(GL_DEPTH_TEST);
  glDisable(GL_DEPTH_CLAMP);
  glDepthMask(GL_TRUE);
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
}

shared::Counters Izb::visibility_counted(const FrameInputs& in, Visibility& out, const gpu::Program& program,
                                         bool culled) {
  visibility(in, out, program, culled);
  return counters_.read<shared::Counters>(1)[0];
}

Counts Izb::count(const FrameInputs& in, Visibility& out) {
  const shared::Counters all = visibility_counted(in, out, counting_all_program_, false);
  const shared::Counters culled = zcull_ ? visibility_counted(in, out, counting_program_, true) : all;
  const std::vector<glm::uvec2> data = read_nodes();
  const uint64_t nodes =
      std::count_if(data.begin(), data.end(), [](glm::uvec2 n) { return n.x < shared::not_a_node(0); });
  const std::vector<float> lengths = list_lengths();
  const float longest = lengths.empty() ? 0.0f : *std::max_element(lengths.begin(), lengths.end());
  return {{"triangles", all.triangles},
          {"triangles_after_zcull", culled.triangles},
          {"fragments", all.fragments},
          {"fragments_after_zcull", culled.fragments},
          {"visibility_tests", culled.visibility_tests},
          {"nodes", nodes},
          {"longest_list", static_cast<uint64_t>(longest)},
          {"pairs_in_double", culled.pairs}};
}

std::vector<glm::uvec2> Izb::read_nodes() const {
  std::vector<glm::uvec2> nodes(size_t(nodes_.width_px()) * nodes_.height_px());
  nodes_.read_bytes(GL_RG_INTEGER, GL_UNSIGNED_INT, nodes.size() * sizeof(glm::uvec2), nodes.data());
  return nodes;
}

std::vector<float> Izb::list_lengths() const {
  const std::vector<uint32_t> heads = heads_.read_uint();
  const std::vector<glm::uvec2> nodes = read_nodes();
  const auto at = [&](uint32_t node) {
    const glm::ivec2 px = shared::pixel_from_node(node);
    return size_t(px.y) * nodes_.width_px() + px.x;
  };
  std::vector<float> lengths(nodes.size(), 0.0f);
  for (const uint32_t head : heads) {
    float length = 0.0f;
    for (uint32_t node = head; node != shared::no_node; node = nodes[at(node)].x) ++length;
    for (uint32_t node = head; node != shared::no_node; node = nodes[at(node)].x) {
      if (lengths[at(node)] != 0.0f) throw std::logic_error("an IZB node stands in two lists");
      lengths[at(node)] = length;
    }
  }
  return lengths;
}

Counts Izb::memory() const {
  return {{"heads", heads_.bytes()},
          {"nodes", nodes_.bytes()},
          {"furthest", furthest_.bytes()},
          {"zcull", depth_.bytes() + pyramid_.bytes()},
          {"pairs", pairs_.bytes() + counters_.bytes()}};
}

}  // namespace

std::unique_ptr<Technique> make_izb() {
  return std::make_unique<Izb>();
}

}  // namespace izb
