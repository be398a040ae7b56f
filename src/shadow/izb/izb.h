// SPDX-License-Identifier: MIT
// Irregular z-buffer shadows after Wyman, Hoetzlein and Lefohn, "Frustum-Traced Raster Shadows: Revisiting Irregular
// Z-Buffers", I3D 2015.
#pragma once
#include "gpu/program.h"
#include "shadow/izb/hardware_raster.h"
#include "shadow/izb/internals.h"
#include "shadow/izb/programs.h"
#include "shadow/technique.h"
#include "shared/pairs.h"

namespace izb {

class Izb final : public Technique {
 public:
  TechniqueInfo info() const override {
    return {"izb", "irregular z-buffer, alias-free hard shadows",
            "C. Wyman, R. Hoetzlein, A. Lefohn: Frustum-Traced Raster Shadows, I3D 2015"};
  }

  OptionSet options() override { return settings_.options(); }
  std::vector<std::string> presets() const override { return IzbSettings::preset_names(); }
  void apply_preset(const std::string& name) override { settings_.apply(name); }

  std::string missing(const gpu::Capabilities& capabilities) const override;

  SamplePattern samples() const override { return settings_.sampling.samples(); }
  GridRequest grid() const override {
    return {settings_.grid,   settings_.nl_cull,     settings_.cascades, settings_.table() ? settings_.table_side() : 0,
            settings_.pool(), settings_.grid_density};
  }

  void resize(const FrameShape& shape) override;
  void render(const FrameInputs& in, Visibility& out, gpu::StageTimers& timers) override;
  std::string fault() const override;
  Counts count(const FrameInputs& in, Visibility& out, bool unculled) override;
  Counts memory() const override;
  gpu::Plan memory_needed(const FrameShape& shape) const override;
  std::vector<float> list_lengths(const FrameInputs& in) override;
  std::vector<uint64_t> list_histogram(const FrameInputs& in) override;
  std::vector<float> tests_a_pixel(const FrameInputs& in, Visibility& out) override;
  std::vector<float> fragments_a_texel(const FrameInputs& in, Visibility& out) override;
  std::optional<SpeedOfLight> speed_of_light(const FrameInputs& in, Visibility& out, int repeats) override;
  std::vector<gpu::ProgramSpec> program_specs() const override { return izb_program_specs(); }

  /// Reads back what `build` and `zcull` left of the last frame; with removal the lists are what `visibility` left,
  /// unless count() or a list_ function came after it. Throws std::logic_error where a node stands in two lists.
  IzbInternals internals() const;
  /// What options() is bound to, and what is no option.
  IzbSettings& settings() { return settings_; }

 private:
  /// How the casters are drawn.
  struct Pass {
    IzbProgram program;
    bool culled;
  };

  /// Grids that the light of the frame takes, one a cascade of each face.
  int layers_of(const FrameInputs& in) const { return built_.cascades * static_cast<int>(in.light.grid.z); }

  void resize_grids(int layers);
  void resize_nodes();
  void occlude(const FrameInputs& in);
  void build(const FrameInputs& in, Visibility* out);
  void insert(const FrameInputs& in, const gpu::Program& program);
  int count_pool(const FrameInputs& in);
  void grow_pool(int rows);
  void zcull(int layers);
  void pyramid(int layers);
  void visibility(const FrameInputs& in, Visibility& out, const Pass& pass);
  void bind_lists(const Visibility& out) const;
  void settle(const FrameInputs& in);
  void draw(const FrameInputs& in, const Pass& pass);
  void draw_by_footprint(const FrameInputs& in, IzbProgram program, Drawn drawn);
  void draw_by_compute(const FrameInputs& in, IzbProgram program, Drawn drawn);
  void ask_alpha(const gpu::Program& program);
  void draw_in_double(const FrameInputs& in, Drawn drawn);
  void draw_by_hardware(const FrameInputs& in, IzbProgram program, Drawn drawn);
  shared::Counters visibility_counted(const FrameInputs& in, Visibility& out, const Pass& pass);

  std::vector<float> work(const FrameInputs& in, Visibility& out, IzbProgram program, gpu::Texture sums);
  gpu::Texture store_tests(const FrameInputs& in, Visibility& out, uint32_t& stored);
  void test_stored(const FrameInputs& in, uint32_t stored);
  void reset_counters();
  shared::Counters read_counters() const { return counters_.read<shared::Counters>(1)[0]; }
  void restore_lists(const FrameInputs& in, Visibility* out);
  IzbLists read_lists() const;

  IzbSettings settings_, built_;  ///< as the options say; as the programs and textures were made
  FrameShape shape_;
  IzbPrograms programs_;
  HardwareRaster hardware_;
  gpu::Texture heads_;     ///< light-space grids of head pointers, one a layer
  gpu::Texture nodes_;     ///< screen-space grid of nodes, or the pool of exact insertion
  gpu::Texture furthest_;  ///< bits of the furthest node's depth
  gpu::Texture depth_;     ///< the same as a depth buffer; before it is that, the occluders'
  gpu::Texture pyramid_;   ///< the same for squares of texels, see shared/pyramid.h
  gpu::Framebuffer light_framebuffer_;
  gpu::VertexArray no_attributes_;
  gpu::Buffer counters_, pairs_, pool_counter_;
  gpu::Buffer listed_, listed_counts_;  ///< of --raster compute, see shared/sweep.h
  gpu::Buffer asked_;                   ///< likewise: pairs whose alpha mask is to be asked
  gpu::BufferTexture table_;
  std::vector<uint32_t> table_words_;  ///< what it holds
  gpu::Query overflow_;
};

std::unique_ptr<Technique> make_izb();

}  // namespace izb
