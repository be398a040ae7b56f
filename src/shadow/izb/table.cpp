// SPDX-License-Identifier: MIT
#include "shadow/izb/table.h"

#include "shared/table.h"

namespace izb {

std::vector<uint32_t> make_visibility_table(const SamplePattern& samples, int side) {
  const int entries = side * shared::table_columns(side);
  std::vector<uint32_t> table(static_cast<size_t>(entries));
  for (int entry = 0; entry < entries; ++entry) {
    const glm::dvec3 line(shared::table_line(entry, side));
    for (int s = 0; s < samples.count(); ++s) {
      const glm::dvec2 o(samples.offsets_px[s]);
      if (line.x + o.x * line.y + o.y * line.z >= 0.0) table[static_cast<size_t>(entry)] |= 1u << s;
    }
  }
  return table;
}

}  // namespace izb
