// SPDX-License-Identifier: MIT
// izb scene: writes a procedural scene as glTF.
#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <algorithm>

#include "app/commands.h"
#include "base/error.h"
#include "scene/glb_writer.h"
#include "scene/procedural.h"

namespace izb {

Command add_scene(CLI::App& app) {
  struct Values {
    std::string name, output;
    int triangles = 0, seed = 1;
  };
  auto o = std::make_shared<Values>();
  CLI::App* sub = app.add_subcommand("scene", "Write a scene that this program makes itself");
  std::vector<std::string> names;
  std::string list = "Scenes:\n";
  for (const Procedural& p : procedurals()) {
    names.push_back(p.name);
    list += fmt::format("  {:<11} {:>10} triangles  {}\n", p.name, p.triangles, p.help);
  }
  sub->add_option("NAME", o->name, "which scene, see below")->required()->check(CLI::IsMember(names));
  sub->add_option("-o,--output", o->output, "where to write it")->required()->type_name("FILE.glb");
  OptionSet set;
  set.integer("triangles", o->triangles, 0, 100'000'000, "",
              "about how many, from some thousands; 0: as many as the scene has by itself");
  set.integer("seed", o->seed, 0, 1 << 30, "", "the same seed gives the same scene everywhere");
  set.add_to(*sub, "Options");
  sub->footer(list);
  return [o] {
    const auto all = procedurals();
    const auto p = std::find_if(all.begin(), all.end(), [&](const Procedural& q) { return o->name == q.name; });
    if (o->triangles != 0 && !p->any_triangles)
      throw UsageError(
          fmt::format("--triangles: the scene '{}' has {} triangles and no other number", p->name, p->triangles));
    const Scene scene = p->make(uint32_t(o->seed), size_t(o->triangles));
    write_glb(scene, o->output);
    fmt::print("wrote {} ({} triangles)\n", o->output, scene.triangle_count());
    return 0;
  };
}

}  // namespace izb
