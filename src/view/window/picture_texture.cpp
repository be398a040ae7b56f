// SPDX-License-Identifier: MIT
#include "view/window/picture_texture.h"

namespace izb {

void PictureTexture::show(const std::shared_ptr<const Image8>& picture, bool smooth) {
  if (picture != shown_ && picture) {
    if (texture_.width_px() != picture->width_px || texture_.height_px() != picture->height_px)
      texture_ = gpu::Texture("picture", GL_RGBA8, picture->width_px, picture->height_px);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTextureSubImage2D(texture_.name(), 0, 0, 0, picture->width_px, picture->height_px,
                        picture->components == 4 ? GL_RGBA : GL_RGB, GL_UNSIGNED_BYTE, picture->pixels.data());
  }
  shown_ = picture;
  if (!shown_) return;
  const GLint filter = smooth ? GL_LINEAR : GL_NEAREST;
  glTextureParameteri(texture_.name(), GL_TEXTURE_MIN_FILTER, filter);
  glTextureParameteri(texture_.name(), GL_TEXTURE_MAG_FILTER, filter);
}

}  // namespace izb
