// SPDX-License-Identifier: MIT
// OSMesa: Mesa's off-screen context, in software. Gone from Mesa since 25.1, hence optional.
#include <GL/osmesa.h>

#include <vector>

#include "base/error.h"
#include "gpu/context.h"

namespace izb::gpu {
namespace {

void* get_proc_address(const char* name) {
  return reinterpret_cast<void*>(OSMesaGetProcAddress(name));
}

class OsmesaContext final : public Context {
 public:
  OsmesaContext() {
    const int attributes[] = {OSMESA_FORMAT,
                              OSMESA_RGBA,
                              OSMESA_PROFILE,
                              OSMESA_CORE_PROFILE,
                              OSMESA_CONTEXT_MAJOR_VERSION,
                              4,
                              OSMESA_CONTEXT_MINOR_VERSION,
                              5,
                              0};
    context_ = OSMesaCreateContextAttribs(attributes, nullptr);
    if (!context_) fail("no OpenGL 4.5 core context");
    if (!OSMesaMakeCurrent(context_, pixels_, GL_UNSIGNED_BYTE, 1, 1)) {
      OSMesaDestroyContext(context_);
      fail("cannot make the context current");
    }
    load_gl(get_proc_address);
  }
  ~OsmesaContext() override {
    OSMesaMakeCurrent(nullptr, nullptr, 0, 0, 0);
    OSMesaDestroyContext(context_);
  }

 private:
  OSMesaContext context_ = nullptr;
  unsigned char pixels_[4] = {};  // everything is drawn into framebuffer objects; this one is never looked at
};

}  // namespace

std::unique_ptr<Context> create_osmesa_context(bool) {
  return std::make_unique<OsmesaContext>();
}

}  // namespace izb::gpu
