// SPDX-License-Identifier: MIT
#include "reference/truth.h"

#include "base/error.h"

namespace izb::reference {

void Receivers::check(const char* doing) const {
  if (own_triangle.size() != count() || classes.size() != count() || band.size() != count() ||
      (!slopes.empty() && slopes.size() != count()) || (!centers_vs.empty() && centers_vs.size() != count()))
    fail("cannot {}: {} points come with {} triangles, {} classes, {} bands, {} slopes and {} centres", doing, count(),
         own_triangle.size(), classes.size(), band.size(), slopes.size(), centers_vs.size());
  if (sample_count() != 1 && sample_count() != 32) fail("cannot {}: {} samples a pixel", doing, sample_count());
}

}  // namespace izb::reference
