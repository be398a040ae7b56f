// SPDX-License-Identifier: MIT
// What validation says of each pixel, as a picture.
#pragma once
#include "app/frame_options.h"
#include "image/png.h"
#include "reference/attribute.h"
#include "reference/settle.h"

namespace izb {

/// Of each pixel the first that applies: red unexplained, magenta leaked by the insertion, cyan wrong by the table,
/// yellow explained, blue settled for the mask, else the mask as a grey between two. `twins`, where there are any, are
/// those of the settled mask.
Image8 verdict_picture(const reference::Receivers& receivers, const reference::Settled& settled,
                       const std::vector<uint32_t>& mask, const reference::MaskTwins* twins, Size size);

}  // namespace izb
