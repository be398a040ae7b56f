// SPDX-License-Identifier: MIT
#include "app/session.h"

#include <cstdlib>

#include "base/error.h"
#include "base/log.h"
#include "base/progress.h"
#include "scene/gltf.h"

namespace izb {

std::unique_ptr<Technique> technique_of(const std::vector<std::string>& arguments) {
  const std::vector<std::string> names = technique_names();
  std::string name = names.front();
  for (size_t i = 0; i < arguments.size(); ++i) {
    if (arguments[i] == "--technique" && i + 1 < arguments.size()) name = arguments[i + 1];
    if (arguments[i].starts_with("--technique=")) name = arguments[i].substr(12);
  }
  // An unknown name is refused by the option itself, with the list of names.
  const bool known = std::find(names.begin(), names.end(), name) != names.end();
  return make_technique(known ? name : names.front());
}

Gl::Gl(const std::string& context_name)
    : context(gpu::create_context(context_name, std::getenv("IZB_GL_DEBUG") != nullptr)),
      capabilities(gpu::query_capabilities()) {
  if (std::getenv("IZB_GL_DEBUG")) gpu::enable_debug_messages();
}

namespace {

Scene load_with_progress(const std::string& path) {
  const Progress progress("loading " + path, 0);
  return load_gltf(path);
}

}  // namespace

Session::Session(const FrameOptions& options, Technique& technique, const std::string& scene_path)
    : scene(load_with_progress(scene_path)),
      frame(choose_frame(options, scene)),
      gl(options.context),
      renderer(scene, gl.capabilities),
      timers(gl.capabilities.software) {
  for (const std::string& sentence : scene.ignored) note("{}: {}", scene_path, sentence);
  renderer.prepare(technique, frame.size.width_px, frame.size.height_px);
}

}  // namespace izb
