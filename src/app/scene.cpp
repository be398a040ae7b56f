// SPDX-License-Identifier: MIT
// izb scene: writes a procedural scene as glTF.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "app/commands.h"
#include "scene/glb_writer.h"
#include "scene/procedural.h"

namespace izb {

Command add_scene(CLI::App& app) {
  struct Values {
    std::string name, output;
    int seed = 1;
  };
  auto o = std::make_shared<Values>();
  CLI::App* sub = app.add_subcommand("scene", "Write a scene that this program makes itself");
  std::vector<std::string> names;
  std::string help = "one of:";
  for (const Procedural& p : procedurals()) {
    names.push_back(p.name);
    help += fmt::format(" {} ({})", p.name, p.help);
  }
  sub->add_option("NAME", o->name, help)->required()->check(CLI::IsMember(names));
  sub->add_option("-o,--output", o->output, "where to write it")->required()->type_name("FILE.glb");
  OptionSet set;
  set.integer("seed", o->seed, 0, 1 << 30, "", "the same seed gives the same scene everywhere");
  set.add_to(*sub, "Options");
  return [o] {
    for (const Procedural& p : procedurals())
      if (o->name == p.name) {
        const Scene scene = p.make(static_cast<uint32_t>(o->seed));
        write_glb(scene, o->output);
        fmt::print("wrote {} ({} triangles)\n", o->output, scene.triangle_count());
      }
    return 0;
  };
}

}  // namespace izb
