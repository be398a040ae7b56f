// SPDX-License-Identifier: MIT
#include "gpu/context.h"

#include "base/error.h"

namespace izb::gpu {
namespace {

struct Factory {
  const char* name;
  std::unique_ptr<Context> (*create)(bool debug);
};

#ifndef IZB_HAVE_OSMESA
[[noreturn]] std::unique_ptr<Context> osmesa_factory(bool) {
  fail("this build has no OSMesa");
}
#else
constexpr auto osmesa_factory = create_osmesa_context;
#endif
#ifndef IZB_HAVE_GLFW
[[noreturn]] std::unique_ptr<Context> glfw_factory(bool) {
  fail("this build has no GLFW");
}
#else
constexpr auto glfw_factory = create_glfw_context;
#endif

constexpr Factory factories[] = {{"egl", create_egl_context}, {"osmesa", osmesa_factory}, {"glfw", glfw_factory}};

}  // namespace

std::vector<std::string> context_names() {
  std::vector<std::string> names{"auto"};
  for (const Factory& f : factories) names.push_back(f.name);
  return names;
}

ContextResult create_context(const std::string& name, bool debug) {
  ContextResult result;
  std::string tried;
  for (const Factory& f : factories) {
    if (name != "auto" && name != f.name) continue;
    try {
      result.context = f.create(debug);
      result.name = f.name;
      result.attempts.push_back({f.name, ""});
      return result;
    } catch (const Error& e) {
      result.attempts.push_back({f.name, e.what()});
      tried += fmt::format("{}{}: {}", tried.empty() ? "" : "; ", f.name, e.what());
    }
  }
  if (tried.empty()) throw UsageError(fmt::format("unknown context '{}'", name));
  fail("no OpenGL 4.5 context ({})", tried);
}

}  // namespace izb::gpu
