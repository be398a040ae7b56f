// SPDX-License-Identifier: MIT
// The visibility look-up table (4) as words for the GPU.
#pragma once
#include <cstdint>
#include <vector>

#include "frame/samples.h"

namespace izb {

/// side directions and side + 2 offsets; see glsl/shared/table.h. Bit s of an entry: sample s lies on or above the line
/// at the entry's centre.
std::vector<uint32_t> make_visibility_table(const SamplePattern& samples, int side);

}  // namespace izb
