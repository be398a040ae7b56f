// SPDX-License-Identifier: MIT
// EGL without a surface: GPUs by the device platform first (NVIDIA has no other), then Mesa's surfaceless platform,
// which is there without any device too, then Mesa's software device, then the default display.
#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <cstring>

#include "base/error.h"
#include "gpu/context.h"

namespace izb::gpu {
namespace {

void* get_proc_address(const char* name) {
  return reinterpret_cast<void*>(eglGetProcAddress(name));
}

const char* egl_error_words() {
  switch (eglGetError()) {
    case EGL_SUCCESS:
      return "no error";
    case EGL_NOT_INITIALIZED:
      return "not initialised";
    case EGL_BAD_ACCESS:
      return "bad access";
    case EGL_BAD_ALLOC:
      return "out of resources";
    case EGL_BAD_ATTRIBUTE:
      return "bad attribute";
    case EGL_BAD_CONFIG:
      return "bad config";
    case EGL_BAD_MATCH:
      return "no such GL version (bad match)";
    case EGL_BAD_PARAMETER:
      return "bad parameter";
    case EGL_BAD_DISPLAY:
      return "bad display";
    default:
      return "unknown EGL error";
  }
}

class EglContext final : public Context {
 public:
  EglContext(EGLDisplay display, std::string platform, bool debug) : display_(display), platform_(std::move(platform)) {
    if (!eglInitialize(display_, nullptr, nullptr)) fail("cannot initialise ({})", egl_error_words());
    try {
      create(debug);
    } catch (...) {
      destroy();
      throw;
    }
  }
  ~EglContext() override { destroy(); }
  std::string platform() const override { return platform_; }

 private:
  void create(bool debug) {
    if (!eglBindAPI(EGL_OPENGL_API)) fail("no desktop OpenGL ({})", egl_error_words());
    const EGLint config_attributes[] = {EGL_SURFACE_TYPE, EGL_DONT_CARE, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
    EGLConfig config = nullptr;
    EGLint count = 0;
    if (!eglChooseConfig(display_, config_attributes, &config, 1, &count) || count == 0)
      fail("no config for desktop OpenGL ({})", egl_error_words());
    // A reset must be told (gpu/gl.h, expect_context); a driver that cannot is taken as it is.
    for (const bool tells_resets : {true, false}) {
      std::vector<EGLint> attributes{EGL_CONTEXT_MAJOR_VERSION,       4,
                                     EGL_CONTEXT_MINOR_VERSION,       5,
                                     EGL_CONTEXT_OPENGL_PROFILE_MASK, EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                     EGL_CONTEXT_OPENGL_DEBUG,        debug ? EGL_TRUE : EGL_FALSE};
      if (tells_resets)
        attributes.insert(attributes.end(),
                          {EGL_CONTEXT_OPENGL_RESET_NOTIFICATION_STRATEGY, EGL_LOSE_CONTEXT_ON_RESET});
      attributes.push_back(EGL_NONE);
      context_ = eglCreateContext(display_, config, EGL_NO_CONTEXT, attributes.data());
      if (context_ != EGL_NO_CONTEXT) break;
    }
    if (context_ == EGL_NO_CONTEXT) fail("no OpenGL 4.5 core context ({})", egl_error_words());
    if (!eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_))
      fail("cannot make the context current without a surface ({})", egl_error_words());
    load_gl(get_proc_address);
  }
  void destroy() {
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    if (context_ != EGL_NO_CONTEXT) eglDestroyContext(display_, context_);
    context_ = EGL_NO_CONTEXT;
    eglTerminate(display_);
  }

  EGLDisplay display_;
  std::string platform_;
  EGLContext context_ = EGL_NO_CONTEXT;
};

struct Platform {
  std::string name;
  EGLDisplay display;
};

bool is_software(EGLDeviceEXT device) {
  const auto query = reinterpret_cast<PFNEGLQUERYDEVICESTRINGEXTPROC>(eglGetProcAddress("eglQueryDeviceStringEXT"));
  const char* extensions = query ? query(device, EGL_EXTENSIONS) : nullptr;
  return extensions && std::strstr(extensions, "EGL_MESA_device_software");
}

std::vector<Platform> platforms() {
  std::vector<Platform> all, software;
  const char* extensions = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  const auto get_display =
      reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(eglGetProcAddress("eglGetPlatformDisplayEXT"));
  const auto has = [&](const char* name) { return extensions && std::strstr(extensions, name); };
  if (get_display && has("EGL_EXT_platform_device") && has("EGL_EXT_device_enumeration")) {
    const auto query_devices = reinterpret_cast<PFNEGLQUERYDEVICESEXTPROC>(eglGetProcAddress("eglQueryDevicesEXT"));
    EGLDeviceEXT devices[16];
    EGLint count = 0;
    if (query_devices && query_devices(16, devices, &count))
      for (EGLint i = 0; i < count; ++i)
        (is_software(devices[i]) ? software : all)
            .push_back({fmt::format("device {}", i), get_display(EGL_PLATFORM_DEVICE_EXT, devices[i], nullptr)});
  }
  if (get_display && has("EGL_MESA_platform_surfaceless"))
    all.push_back({"surfaceless", get_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr)});
  all.insert(all.end(), software.begin(), software.end());
  all.push_back({"default display", eglGetDisplay(EGL_DEFAULT_DISPLAY)});
  return all;
}

}  // namespace

std::unique_ptr<Context> create_egl_context(bool debug) {
  std::string tried;
  for (const Platform& p : platforms()) {
    if (p.display == EGL_NO_DISPLAY) continue;
    try {
      return std::make_unique<EglContext>(p.display, p.name, debug);
    } catch (const Error& e) {
      tried += fmt::format("{}{}: {}", tried.empty() ? "" : ", ", p.name, e.what());
    }
  }
  fail("{}", tried.empty() ? "no EGL display" : tried);
}

}  // namespace izb::gpu
