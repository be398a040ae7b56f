// SPDX-License-Identifier: MIT
#include "shadow/izb/settings.h"

#include <algorithm>

#include "base/error.h"

namespace izb {

OptionSet IzbSettings::options() {
  OptionSet set;
  sampling.declare(set);
  set.choice("coverage", coverage, {"lut", "exact"},
             "at 32 samples: by the visibility look-up table (4), or sample by sample");
  set.choice("lut", lut, {"32", "64", "128"}, "side of the look-up table; the paper's is 32");
  set.choice(
      "insertion", insertion, {"approximate", "nv", "samples", "exact"},
      "at 32 samples, where a pixel's nodes go (6.1): a row along its longest axis in light space, the same counted "
      "by N.V alone, the texels of its samples, or every texel that its micro-quad touches");
  set.integer("nodes", nodes, 1, 8, "nodes", "at most so many a pixel, but for exact insertion (6.1)");
  set.number("dilation", dilation_texels, 0.5, 4.0, "texels",
             "by which triangles grow in light space (6.1); exact insertion needs and takes 0.5");
  set.integer("grid", grid, 16, 16384, "texels", "side of the light-space grid of lists (6.3)");
  set.integer("cascades", cascades, 1, 8, "cascades", "grids, by a logarithmic split of the visible depth range (6.4)");
  set.choice("cascade-pass", cascade_pass, {"single", "multiple"},
             "draw the casters once for all cascades, or once for each as in the paper (5.5)");
  set.flag("removal", removal, "unlink the nodes of fully shadowed pixels (6.6)");
  set.flag("unchanged-skip", unchanged_skip, "no atomic where the mask has the bits already (6.7)");
  set.flag("pipelining", pipelining, "fetch each node one round of the walk ahead (6.8)");
  set.flag("nl-cull", nl_cull, "leave pixels with N.L <= 0 out of the lists (6.5)");
  set.flag("zcull", zcull, "light-space culling prepass and early z (5.4)");
  set.flag("zcull-pyramid", zcull_pyramid,
           "with z-cull, end triangles that no receiver lies behind in the geometry shader, by a pyramid of furthest "
           "depths");
  set.integer("pairs", pair_capacity, 0, 1 << 24, "pairs",
              "room for triangle-pixel pairs that single precision cannot decide; when it is exceeded a second pass "
              "decides them in double");
  return set;
}

std::vector<std::string> IzbSettings::preset_names() {
  return {"paper", "exact"};
}

void IzbSettings::apply(const std::string& preset) {
  if (preset == "paper") {  // table 1: four cascades of 2048 x 2048, every optimisation of section 6
    sampling = {"32", "halton"};
    lut = "32";
    cascades = 4;
    cascade_pass = "multiple";
    removal = unchanged_skip = pipelining = true;
  } else if (preset == "exact") {
    sampling.spp = "32";
    coverage = insertion = "exact";
    pair_capacity = 1 << 22;
  } else {
    throw UsageError(fmt::format("unknown preset '{}': there are {}", preset, fmt::join(preset_names(), ", ")));
  }
}

gpu::ProgramSpec izb_program_spec(IzbProgram program, const IzbSettings& s) {
  const std::string folder = "shadow/izb/";
  gpu::Defines defines;
  const auto define = [&](bool on, const char* name) {
    if (on) defines[name] = "1";
  };
  const auto walk_defines = [&] {
    define(s.many_samples(), "SPP32");
    define(s.table(), "TABLE");
    define(s.pool(), "POOL");
  };
  const auto visibility = [&](bool pyramid, const char* variant) -> gpu::ProgramSpec {
    walk_defines();
    define(pyramid, "PYRAMID");
    define(s.removal, "REMOVAL");
    define(s.unchanged_skip, "SKIP");
    define(s.pipelining, "PIPELINE");
    if (s.cascades > 1) defines["CASCADES"] = std::to_string(s.layers_a_pass());
    if (*variant) defines[variant] = "1";
    return {fmt::format("izb visibility {}", variant),
            {folder + "5_visibility.vert.glsl", folder + "5_visibility.geom.glsl", folder + "5_visibility.frag.glsl"},
            defines};
  };
  const auto build = [&](bool count) -> gpu::ProgramSpec {
    define(s.zcull, "ZCULL");
    define(s.many_samples(), "SPP32");
    if (s.many_samples())
      define(true, s.insertion == "approximate" ? "ALONG_AXIS"
                   : s.insertion == "nv"        ? "BY_VIEW"
                   : s.insertion == "samples"   ? "BY_SAMPLES"
                                                : "POOL");
    define(count, "COUNT_NODES");
    if (s.insertion_stride != 1) defines["STRIDE"] = fmt::format("{}u", s.insertion_stride);
    return {"izb build", {folder + "3_build.comp.glsl"}, defines};
  };
  switch (program) {
    case IzbProgram::build:
      return build(false);
    case IzbProgram::count_nodes:
      return build(true);
    case IzbProgram::zcull:
      return {"izb zcull", {folder + "4_zcull.vert.glsl", folder + "4_zcull.frag.glsl"}, {}};
    case IzbProgram::pyramid_first:
      define(true, "FIRST_LEVEL");
      [[fallthrough]];
    case IzbProgram::pyramid:
      return {"izb zcull pyramid", {folder + "4_zcull_pyramid.comp.glsl"}, defines};
    case IzbProgram::visibility:
      return visibility(s.pyramid(), "");
    case IzbProgram::visibility_in_double:
      return visibility(s.pyramid(), "IN_DOUBLE");
    case IzbProgram::visibility_counted:
      return visibility(s.pyramid(), "COUNT");
    case IzbProgram::visibility_counted_all:
      return visibility(false, "COUNT");
    case IzbProgram::settle:
      walk_defines();
      return {"izb visibility settle", {folder + "5_visibility_settle.comp.glsl"}, defines};
    default:
      return {"izb visibility overflow",
              {folder + "5_visibility_overflow.vert.glsl", folder + "5_visibility_overflow.frag.glsl"},
              {}};
  }
}

std::vector<gpu::ProgramSpec> izb_program_specs() {
  std::vector<gpu::ProgramSpec> all;
  const auto add = [&](const IzbSettings& settings) {
    for (int p = 0; p < static_cast<int>(IzbProgram::count); ++p) {
      const IzbProgram program = static_cast<IzbProgram>(p);
      if (program == IzbProgram::count_nodes && !settings.pool()) continue;
      gpu::ProgramSpec spec = izb_program_spec(program, settings);
      const bool known = std::any_of(all.begin(), all.end(), [&](const gpu::ProgramSpec& other) {
        return other.files == spec.files && other.defines == spec.defines;
      });
      if (!known) all.push_back(std::move(spec));
    }
  };
  add({});
  for (const std::string& preset : IzbSettings::preset_names()) {
    IzbSettings settings;
    settings.apply(preset);
    add(settings);
  }
  IzbSettings settings;
  const OptionSet set = settings.options();
  for (const Option& option : set.options()) {
    std::vector<std::string> values = option.choices;
    if (std::holds_alternative<bool*>(option.value)) values = {"on", "off"};
    if (option.name == "cascades") values = {"2", "8"};
    for (const std::string& value : values) {
      settings = IzbSettings();
      option.set(value);
      add(settings);
    }
    settings = IzbSettings();
  }
  settings.insertion_stride = 7;
  add(settings);
  return all;
}

}  // namespace izb
