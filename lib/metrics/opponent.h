// The colour spaces of FLIP. Linear RGB has Rec. 709 primaries and white D65; XYZ is relative to that white.
#pragma once

#include <array>

namespace pullfocus {

using Triple = std::array<double, 3>;

// Y_y, c_x, c_z: L*a*b* without its cube roots, linear in RGB (Zhang and Wandell 1997).
Triple to_ycxcz(const Triple& rgb) noexcept;
Triple from_ycxcz(const Triple& ycxcz) noexcept;

// CIE 1976 L*a*b* with a* and b* times 0.01 L* (Hunt 1952: colours look more colourful in brighter light).
Triple to_hunt_lab(const Triple& rgb) noexcept;

// |dL| + sqrt(da^2 + db^2) (Abasi et al. 2019).
double hyab(const Triple& a, const Triple& b) noexcept;

}  // namespace pullfocus
