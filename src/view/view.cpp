// SPDX-License-Identifier: MIT
// izb view: the interactive program.
#include <CLI/CLI.hpp>
#include <filesystem>

#include "app/commands.h"
#include "app/session.h"
#include "base/error.h"
#include "base/file.h"
#include "view/run_view.h"
#include "view/settings.h"

namespace izb {
namespace {

namespace fs = std::filesystem;

struct Values {
  FrameOptions frame;
  ViewOptions view;
  std::string scene;
  std::unique_ptr<Technique> technique;

  OptionSet options() {
    OptionSet set;
    set.text("state", view.state, "FILE", "begin as a saved state says; the scene and other options are then its own");
    set.text("folder", view.folder, "FOLDER", "where screenshots, camera paths and states go");
    set.text("settings", view.settings, "FILE",
             "what is remembered from start to start; by default izb/view.json in $XDG_CONFIG_HOME");
    set.text("report", view.report, "FILE", "write what happens as JSON lines, for scripts: see docs/VIEW.md");
    return set;
  }
};

/// Of the build or of the installed program.
std::string shipped_scene() {
  std::error_code ignored;
  const fs::path program = fs::read_symlink("/proc/self/exe", ignored).parent_path();
  for (const char* below : {"assets/garden.glb", "../share/izb/garden.glb"})
    if (fs::exists(program / below, ignored)) return (program / below).lexically_normal().string();
  fail("the shipped scene is not there: `izb scene garden -o garden.glb` makes it, `izb view garden.glb` shows it");
}

ViewState state_of(const Values& o) {
  if (!o.view.state.empty()) {
    try {
      ViewState state = ViewState::from_json(nlohmann::json::parse(read_text_file(o.view.state)));
      if (state.scene.empty()) fail("it names no scene");
      return state;
    } catch (const nlohmann::json::exception& e) {
      fail("cannot read the state '{}': {}", o.view.state, e.what());
    } catch (const Error& e) {
      fail("cannot read the state '{}': {}", o.view.state, e.what());
    }
  }
  ViewState state;
  // A command that is copied works from any folder.
  state.scene = o.scene.empty() ? shipped_scene() : fs::absolute(o.scene).lexically_normal().string();
  state.frame = o.frame;
  state.sides[0] = {o.technique->info().name, o.technique->options().to_json()};
  state.sides[1] = SideState::of("izb");
  state.sides[1].options["spp"] = "1";
  return state;
}

}  // namespace

Command add_view(CLI::App& app, const Arguments& arguments) {
  auto o = std::make_shared<Values>();
  o->technique = technique_of(arguments);
  CLI::App* sub = app.add_subcommand("view", "Look at a scene, or at the shipped one, in a window (F1: keys)");
  sub->add_option("SCENE", o->scene, "a .gltf or .glb file");
  o->options().add_to(*sub, "Viewer");
  o->frame.options().add_to(*sub, "Frame");
  sub->get_option("--fov")->needs(sub->get_option("--eye"));
  o->technique->options().add_to(*sub, "Technique " + o->technique->info().name);
  return [o] {
    parse_size(o->frame.size);
    if (o->frame.context != "auto" && o->frame.context != "egl")
      throw UsageError(
          "--context: the window's picture is painted through EGL; --context osmesa and glfw are for izb render");
    o->view.context = "egl";
    if (o->view.settings.empty()) o->view.settings = default_settings_file().string();
    std::error_code ignored;
    if (!fs::is_directory(o->view.folder, ignored)) fail("--folder: there is no folder '{}'", o->view.folder);
    return run_view(o->view, state_of(*o));
  };
}

}  // namespace izb
