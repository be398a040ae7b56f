// SPDX-License-Identifier: MIT
// Colour spaces in which differences are measured. All values are in double.
#pragma once
#include <array>

namespace izb::cie {

using Triple = std::array<double, 3>;

/// Linear sRGB to CIE 1931 XYZ, white's Y = 1, and back: from the primaries of IEC 61966-2-1 and the white D65 to five
/// digits, (0.31271, 0.32902). The standard rounds it to (0.3127, 0.3290), with which FLIP is up to 8e-6 off its
/// authors'.
Triple rgb_to_xyz(const Triple& linear);
Triple xyz_to_rgb(const Triple& xyz);

/// The opponent space YyCxCz, a linear relative of L*a*b* (Flohr, Kolpatzik, Balasubramanian, Carrara, Bouman and
/// Allebach 1993), relative to sRGB's white: Yy from -16 to 100, red-green, blue-yellow.
Triple xyz_to_opponent(const Triple& xyz);
Triple opponent_to_xyz(const Triple& opponent);

/// CIE 1976 L*a*b*, relative to sRGB's white.
Triple xyz_to_lab(const Triple& xyz);

}  // namespace izb::cie
