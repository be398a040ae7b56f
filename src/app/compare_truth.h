// SPDX-License-Identifier: MIT
// The masks of a file, made by whatever program, against the ray-traced truth of the frame that they are of.
#pragma once
#include <memory>
#include <string>

#include "app/comparison.h"
#include "app/frame_options.h"

namespace izb {

/// Compares the masks in the OpenEXR file `mask` with the exact truth: rays at the sample points of `ray_traced`, a
/// technique of that name, bits that they dispute settled as `izb validate` does. The channel is `mask` for one light,
/// for several `mask.NAME` each; an empty `frame.size` is the mask's own. Throws izb::Error if a file cannot be read, a
/// mask is missing, of another size, or has more samples than the technique; or as Session does.
Comparison compare_with_truth(const std::string& scene, const std::string& mask, FrameOptions frame,
                              std::unique_ptr<Technique> ray_traced);

}  // namespace izb
