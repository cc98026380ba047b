// What hides what: settings.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace pullfocus {

struct VisibilityOptions {
  enum class Kind {
    none,    // plain scatter: every source reaches everything within its kernel
    layers,  // sources of nearer layers lie before those of farther ones, see resolve/resolve.h
    bitmap   // occlusion bitmaps, see scatter/occlusion.h
  };
  Kind kind = Kind::layers;
  std::vector<double> borders{-2, 2};  // layers: signed CoC diameters in pixels, ascending, at most 15
  int bitmap_size = 32;                // bitmap: L, pixels; even, 2..64. Farther away than that nothing is hidden
  double cutoff_px = 3;  // bitmap: K, pixels of CoC diameter; >= 0. Diameters closer than that never hide each other
};

// "auto" and "layers" (with the default borders), "layers:-8,-2,2", "none", "bitmap" or "bitmap:L"; the other fields
// keep their defaults. Throws Error(usage) naming --visibility.
VisibilityOptions parse_visibility(std::string_view text);

// Throws Error(usage) naming --visibility or --cutoff.
void validate(const VisibilityOptions& options);

std::string describe(const VisibilityOptions& options);

// Between the layers; none where there is but one, without layers. Lives as long as `options`.
std::span<const double> layer_borders(const VisibilityOptions& options) noexcept;

}  // namespace pullfocus
