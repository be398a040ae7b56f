// SPDX-License-Identifier: MIT
// izb info: what the machine offers, and what a scene holds.
#include <CLI/CLI.hpp>

#include "app/commands.h"
#include "app/session.h"
#include "base/log.h"
#include "base/table.h"
#include "gpu/program_cache.h"
#include "reference/embree.h"
#include "scene/gltf.h"
#include "scene/view.h"

namespace izb {
namespace {

void print_gl(const std::string& context_name) {
  const Gl gl(context_name);
  Table table({{"OpenGL", Align::left}, {"", Align::left}});
  const std::string platform = gl.context.context->platform();
  const std::string taken = platform.empty() ? "taken" : fmt::format("taken (platform: {})", platform);
  for (const gpu::ContextAttempt& attempt : gl.context.attempts)
    table.add_row({"context " + attempt.name, attempt.failure.empty() ? taken : attempt.failure});
  for (const auto& [name, value] : gpu::describe(gl.capabilities)) table.add_row({name, value});
  const gpu::Room room = gpu::memory_room(gl.capabilities);
  table.add_row({"memory available", room.bytes ? gpu::megabytes(*room.bytes) : "not said by the system"});
  const std::optional<std::filesystem::path> programs = gpu::program_cache_folder();
  table.add_row({"program cache", programs ? programs->string() : "off"});
  table.add_row({"ray tracer", reference::embree_version()});
  fmt::print("{}", table.str());
}

void print_scene(const std::string& path) {
  const Scene scene = load_gltf(path);
  const Bounds bounds = world_bounds(scene);
  size_t unique = 0, masked = 0, blended = 0;
  for (const Mesh& mesh : scene.meshes) unique += mesh.triangle_count();
  for (const Material& m : scene.materials) {
    masked += m.alpha_mode == AlphaMode::mask;
    blended += m.alpha_mode == AlphaMode::blend;
  }
  Table table({{"scene", Align::left}, {path, Align::left}});
  table.add_row({"triangles", fmt::format("{} placed, {} unique", scene.triangle_count(), unique)});
  table.add_row({"meshes", fmt::format("{}, placed {} times", scene.meshes.size(), scene.instances.size())});
  table.add_row({"geometry", gpu::megabytes(scene.geometry_bytes())});
  table.add_row({"materials", fmt::format("{} ({} alpha-masked; {} blended, which cast and receive as opaque)",
                                          scene.materials.size(), masked, blended)});
  table.add_row({"textures", fmt::format("{}", scene.textures.size())});
  table.add_row({"bounds", fmt::format("({:.4g}, {:.4g}, {:.4g}) to ({:.4g}, {:.4g}, {:.4g})", bounds.min.x,
                                       bounds.min.y, bounds.min.z, bounds.max.x, bounds.max.y, bounds.max.z)});
  for (size_t i = 0; i < scene.cameras.size(); ++i)
    table.add_row(
        {fmt::format("camera {}", i), fmt::format("{} ({})", scene.cameras[i].name,
                                                  scene.cameras[i].orthographic ? "orthographic" : "perspective")});
  for (size_t i = 0; i < scene.lights.size(); ++i)
    table.add_row(
        {fmt::format("light {}", i), fmt::format("{} ({})", scene.lights[i].name, type_name(scene.lights[i].type))});
  for (size_t i = 0; i < scene.animations.size(); ++i)
    table.add_row({fmt::format("animation {}", i),
                   fmt::format("{} ({:.3g} s)", scene.animations[i].name, scene.animations[i].length_s)});
  for (const std::string& sentence : scene.ignored) table.add_row({"ignored", sentence});
  fmt::print("{}", table.str());
}

}  // namespace

Command add_info(CLI::App& app) {
  struct Values {
    std::string scene, context = "auto";
  };
  auto o = std::make_shared<Values>();
  CLI::App* sub = app.add_subcommand("info", "Show the GL context and, with a scene, what it holds");
  sub->add_option("SCENE", o->scene, "a .gltf or .glb file");
  OptionSet set;
  set.choice("context", o->context, gpu::context_names(), "how to get an OpenGL 4.5 context");
  set.add_to(*sub, "Options");
  return [o] {
    print_gl(o->context);
    if (!o->scene.empty()) print_scene(o->scene);
    return 0;
  };
}

}  // namespace izb
