// SPDX-License-Identifier: MIT
// Colour spaces in which differences are measured. All values are in double.
#pragma once
#include <array>

namespace izb::cie {

using Triple = std::array<double, 3>;

/// Linear sRGB to CIE 1931 XYZ, white's Y = 1, and back: from the primaries and the white of IEC 61966-2-1.
Triple rgb_to_xyz(const Triple& linear);
Triple xyz_to_rgb(const Triple& xyz);

/// The opponent space YyCxCz, a linear relative of L*a*b* (Flohr, Kolpatzik, Balasubramanian, Carrara, Bouman and
/// Allebach 1993), relative to sRGB's white: Yy from -16 to 100, red-green, blue-yellow.
Triple xyz_to_opponent(const Triple& xyz);
Triple opponent_to_xyz(const Triple& opponent);

/// CIE 1976 L*a*b*, relative to sRGB's white.
Triple xyz_to_lab(const Triple& xyz);

}  // namespace izb::cie
