// SPDX-License-Identifier: MIT
// A picture of the painter on the window's own GL context.
#pragma once
#include <memory>

#include "gpu/objects.h"
#include "image/image.h"

namespace izb {

class PictureTexture {
 public:
  /// Uploads, unless that picture is there already; null: nothing is shown. `smooth`: it will be magnified.
  void show(const std::shared_ptr<const Image8>& picture, bool smooth);
  explicit operator bool() const { return shown_ != nullptr; }
  /// As Dear ImGui takes it.
  void* id() const { return reinterpret_cast<void*>(uintptr_t(texture_.name())); }
  const Image8& picture() const { return *shown_; }

 private:
  std::shared_ptr<const Image8> shown_;
  gpu::Texture texture_;
};

}  // namespace izb
