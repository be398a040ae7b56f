// SPDX-License-Identifier: MIT
#include "shadow/izb/programs.h"

#include <algorithm>

#include "base/error.h"
#include "shared/light.h"

namespace izb {

namespace {

bool belongs(IzbProgram program, const IzbSettings& settings) {
  if (program == IzbProgram::occluders) return settings.occluders;
  if (program == IzbProgram::count_nodes) return settings.pool();
  if (program >= IzbProgram::hardware && program <= IzbProgram::hardware_stored) return settings.hardware();
  if (program >= IzbProgram::list && program <= IzbProgram::sweep_stored) return settings.compute();
  if (program == IzbProgram::alpha || program == IzbProgram::alpha_counted) return settings.lists_alpha();
  return true;
}

/// Takes no part in a frame.
bool measures(IzbProgram program) {
  return (program >= IzbProgram::visibility_counted && program <= IzbProgram::visibility_stored) ||
         (program >= IzbProgram::hardware_counted && program <= IzbProgram::hardware_stored) ||
         program == IzbProgram::list_all || (program > IzbProgram::tiles && program <= IzbProgram::tiles_counted_all) ||
         (program >= IzbProgram::sweep_counted && program <= IzbProgram::sweep_stored) ||
         program == IzbProgram::alpha_counted || program == IzbProgram::speed_of_light;
}

}  // namespace

bool knows_masks(IzbProgram program, const IzbSettings& settings) {
  if (program == IzbProgram::alpha || program == IzbProgram::alpha_counted || program == IzbProgram::settle ||
      program == IzbProgram::speed_of_light)
    return settings.alpha == "exact";  // else the walk has asked before
  if (program >= IzbProgram::list && program <= IzbProgram::tiles_counted_all) return false;
  return settings.alpha_masks() && program >= IzbProgram::visibility && program <= IzbProgram::sweep_stored;
}

Beside beside(IzbProgram visibility) {
  using P = IzbProgram;
  switch (visibility) {
    case P::visibility:
      return {P::hardware, P::sweep};
    case P::visibility_in_double:
      return {P::hardware_in_double, P::count};
    case P::visibility_counted_all:
      return {P::hardware_counted, P::sweep_counted_all};
    case P::visibility_tests:
      return {P::hardware_tests, P::sweep_tests};
    case P::visibility_fragments:
      return {P::hardware_fragments, P::sweep_fragments};
    case P::visibility_stored:
      return {P::hardware_stored, P::sweep_stored};
    default:
      return {P::hardware_counted, P::sweep_counted};
  }
}

gpu::ProgramSpec izb_program_spec(IzbProgram program, const IzbSettings& s, LightKind light, bool masked) {
  const std::string folder = "shadow/izb/";
  gpu::Defines defines;
  const auto define = [&](bool on, const char* name) {
    if (on) defines[name] = "1";
  };
  const auto light_defines = [&] { define(light == LightKind::directional, "DIRECTIONAL"); };
  const auto walk_defines = [&] {
    light_defines();
    define(s.many_samples(), "SPP32");
    define(s.table(), "TABLE");
    define(s.pool(), "POOL");
    define(masked, "MASKED");
    define(masked, s.alpha == "exact" ? "ALPHA_EXACT" : "ALPHA_FRAGMENT");
  };
  const int faces = light == LightKind::cube ? shared::cube_faces : 1;
  const auto texel_defines = [&](const std::string& variant) {
    walk_defines();
    define(faces > 1, "CUBE");
    define(s.removal, "REMOVAL");
    define(s.unchanged_skip, "SKIP");
    if (!variant.empty()) defines[variant] = "1";
    define(variant.starts_with("COUNT_"), "COUNT");
  };
  const auto fragment_defines = [&](const std::string& variant) {
    texel_defines(variant);
    define(s.pipelining, "PIPELINE");
    if (s.cascades * faces > 1) defines["LAYERS"] = std::to_string(s.compute() ? 1 : s.layers_a_pass(faces));
  };
  const auto visibility = [&](bool pyramid, const char* variant) -> gpu::ProgramSpec {
    fragment_defines(variant);
    define(pyramid, "PYRAMID");
    define(s.hardware(), "REST");
    if (s.compute()) {
      define(true, "PULL");
      defines.insert(s.geometry.begin(), s.geometry.end());
    }
    return {fmt::format("izb visibility {}", variant),
            {folder + "5_visibility.vert.glsl", folder + "5_visibility.geom.glsl", folder + "5_visibility.frag.glsl"},
            defines};
  };
  const auto hardware = [&](const char* variant) -> gpu::ProgramSpec {
    fragment_defines(variant);
    define(true, "HW");
    return {
        fmt::format("izb visibility hw {}", variant),
        {folder + "5_visibility.vert.glsl", folder + "5_visibility_hw.geom.glsl", folder + "5_visibility.frag.glsl"},
        defines,
        {"GL_NV_geometry_shader_passthrough"}};
  };
  const auto sweep = [&](bool culled, const char* variant) -> gpu::ProgramSpec {
    texel_defines(variant);
    define(true, "SWEEP");
    define(culled && s.zcull, "ZCULL");
    defines.insert(s.geometry.begin(), s.geometry.end());
    return {fmt::format("izb visibility sweep {}", variant), {folder + "5_visibility.comp.glsl"}, defines};
  };
  const auto list = [&](const char* name, bool culled, bool counted) -> gpu::ProgramSpec {
    light_defines();
    define(faces > 1, "CUBE");
    define(s.many_samples(), "SPP32");
    define(culled && s.pyramid(), "PYRAMID");
    define(counted, "COUNT");
    defines.insert(s.geometry.begin(), s.geometry.end());
    return {fmt::format("izb visibility {}", name), {folder + fmt::format("5_visibility_{}.comp.glsl", name)}, defines};
  };
  const auto build = [&](bool count) -> gpu::ProgramSpec {
    light_defines();
    define(faces > 1, "CUBE");
    define(s.zcull, "ZCULL");
    define(s.occluders, "OCCLUDERS");
    define(s.many_samples(), "SPP32");
    if (s.many_samples())
      define(true, s.insertion == "approximate" ? "COVER"
                   : s.insertion == "nv"        ? "BY_VIEW"
                   : s.insertion == "samples"   ? "BY_SAMPLES"
                                                : "POOL");
    define(count, "COUNT_NODES");
    if (s.insertion_stride != 1) defines["STRIDE"] = fmt::format("{}u", s.insertion_stride);
    return {"izb build", {folder + "3_build.comp.glsl"}, defines};
  };
  switch (program) {
    case IzbProgram::occluders:
      light_defines();
      define(faces > 1, "CUBE");
      if (s.cascades * faces > 1) defines["LAYERS"] = std::to_string(s.layers_a_pass(faces));
      return {"izb occluders",
              {folder + "5_visibility.vert.glsl", folder + "3_occluders.geom.glsl", folder + "3_occluders.frag.glsl"},
              defines};
    case IzbProgram::build:
      return build(false);
    case IzbProgram::count_nodes:
      return build(true);
    case IzbProgram::zcull:
      return {
          "izb zcull", {folder + "4_zcull.vert.glsl", folder + "4_zcull.geom.glsl", folder + "4_zcull.frag.glsl"}, {}};
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
    case IzbProgram::visibility_tests:
      return visibility(s.pyramid(), "COUNT_TESTS");
    case IzbProgram::visibility_fragments:
      return visibility(s.pyramid(), "COUNT_FRAGMENTS");
    case IzbProgram::visibility_stored:
      return visibility(s.pyramid(), "STORE_TESTS");
    case IzbProgram::hardware:
      return hardware("");
    case IzbProgram::hardware_in_double:
      return hardware("IN_DOUBLE");
    case IzbProgram::hardware_counted:
      return hardware("COUNT");
    case IzbProgram::hardware_tests:
      return hardware("COUNT_TESTS");
    case IzbProgram::hardware_fragments:
      return hardware("COUNT_FRAGMENTS");
    case IzbProgram::hardware_stored:
      return hardware("STORE_TESTS");
    case IzbProgram::list:
      return list("list", true, false);
    case IzbProgram::list_all:
      return list("list", false, false);
    case IzbProgram::tiles:
      return list("tiles", true, false);
    case IzbProgram::tiles_counted:
      return list("tiles", true, true);
    case IzbProgram::tiles_counted_all:
      return list("tiles", false, true);
    case IzbProgram::sweep:
      return sweep(true, "");
    case IzbProgram::sweep_counted:
      return sweep(true, "COUNT");
    case IzbProgram::sweep_counted_all:
      return sweep(false, "COUNT");
    case IzbProgram::sweep_tests:
      return sweep(true, "COUNT_TESTS");
    case IzbProgram::sweep_fragments:
      return sweep(true, "COUNT_FRAGMENTS");
    case IzbProgram::sweep_stored:
      return sweep(true, "STORE_TESTS");
    case IzbProgram::alpha:
    case IzbProgram::alpha_counted:
      walk_defines();
      define(s.unchanged_skip, "SKIP");
      define(program == IzbProgram::alpha_counted, "COUNT");
      defines.insert(s.geometry.begin(), s.geometry.end());
      return {"izb visibility alpha", {folder + "5_visibility_alpha.comp.glsl"}, defines};
    case IzbProgram::speed_of_light:
      walk_defines();
      define(s.unchanged_skip, "SKIP");
      defines.insert(s.geometry.begin(), s.geometry.end());
      return {"izb speed of light", {folder + "5_visibility_speed_of_light.comp.glsl"}, defines};
    case IzbProgram::settle:
      walk_defines();
      defines.insert(s.geometry.begin(), s.geometry.end());
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
      if (!belongs(program, settings)) continue;
      for (const LightKind light : {LightKind::directional, LightKind::positional, LightKind::cube})
        for (const bool masked : {false, true}) {
          if (masked && !knows_masks(program, settings)) continue;
          gpu::ProgramSpec spec = izb_program_spec(program, settings, light, masked);
          const bool known = std::any_of(all.begin(), all.end(), [&](const gpu::ProgramSpec& other) {
            return other.files == spec.files && other.defines == spec.defines;
          });
          if (!known) all.push_back(std::move(spec));
        }
    }
  };
  add({});
  for (const std::string& preset : IzbSettings::preset_names()) {
    IzbSettings settings;
    settings.apply(preset);
    add(settings);
    for (const char* raster : {"hw", "compute"}) {
      settings.raster = raster;
      add(settings);
    }
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
  settings = IzbSettings();
  settings.geometry = {{"POSITION_WINDOWS", "2"}, {"INDEX_WINDOWS", "3"}, {"WINDOW_WORDS", "192u"}};
  add(settings);
  settings.raster = "compute";
  add(settings);
  return all;
}

void IzbPrograms::follow(const IzbSettings& settings) {
  settings_ = settings;
  for (const LightKind light : {LightKind::directional, LightKind::positional, LightKind::cube})
    for (const bool masked : {false, true})
      for (int p = 0; p < static_cast<int>(IzbProgram::count); ++p) {
        gpu::Program& made = programs_[static_cast<size_t>(light)][masked][static_cast<size_t>(p)];
        if (made && !made.is(izb_program_spec(static_cast<IzbProgram>(p), settings_, light, masked)))
          made = gpu::Program();
      }
}

void IzbPrograms::prepare(LightKind light, bool masked_casters) {
  light_ = light;
  for (int p = 0; p < static_cast<int>(IzbProgram::count); ++p) {
    const IzbProgram each = static_cast<IzbProgram>(p);
    if (!belongs(each, settings_) || measures(each)) continue;
    for (const bool masked : {false, true})
      if (!masked || (masked_casters && knows_masks(each, settings_))) get(each, masked);
  }
}

const gpu::Program& IzbPrograms::get(IzbProgram program, bool masked) {
  gpu::Program& made = programs_[static_cast<size_t>(light_)][masked][static_cast<size_t>(program)];
  if (!made) made = gpu::Program(izb_program_spec(program, settings_, light_, masked));
  return made;
}

}  // namespace izb
