// SPDX-License-Identifier: MIT
#include "shadow/izb/table.h"

#include "shared/table.h"

namespace izb {

std::vector<uint32_t> make_visibility_table(const SamplePattern& samples, int side) {
  std::vector<uint32_t> table(size_t(side) * side);
  for (int entry = 0; entry < side * side; ++entry) {
    const glm::dvec3 line(shared::table_line(entry, side));
    for (int s = 0; s < samples.count(); ++s) {
      const glm::dvec2 o(samples.offsets_px[s]);
      if (line.x + o.x * line.y + o.y * line.z >= 0.0) table[entry] |= 1u << s;
    }
  }
  return table;
}

}  // namespace izb
