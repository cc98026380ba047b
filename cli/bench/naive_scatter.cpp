#include "bench/naive_scatter.h"

#include <algorithm>
#include <cstdlib>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bench/naive_scatter.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace pullfocus::cli::bench {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// `weights` begins on a vector of sums, `count` pixels from there on are to be added.
template <typename Real>
HWY_INLINE void AddInterleaved(const Real* HWY_RESTRICT colour, const Real* HWY_RESTRICT weights, int count,
                               Real* HWY_RESTRICT out) {
  const hn::ScalableTag<Real> d;
  constexpr int lanes = static_cast<int>(hn::MaxLanes(d));
  if constexpr (lanes <= 4) {
    constexpr int parts = 4 / lanes;
    for (int i = 0; i < count; ++i) {
      const auto weight = hn::Set(d, weights[i]);
      for (int k = 0; k < parts; ++k, out += lanes)
        hn::Store(hn::MulAdd(hn::LoadU(d, colour + k * lanes), weight, hn::Load(d, out)), d, out);
    }
  } else {
    constexpr int pixels = lanes / 4;
    const auto rgbw = hn::LoadU(d, colour);  // four values, repeated
    hn::TFromD<hn::RebindToSigned<decltype(d)>> lane_of[lanes];
    for (int i = 0; i < lanes; ++i) lane_of[i] = i / 4;
    const auto lookup = hn::SetTableIndices(d, lane_of);
    for (int i = 0; i < count; i += pixels, out += lanes) {
      const auto weight = hn::TableLookupLanes(hn::LoadDup128(d, weights + i), lookup);
      hn::Store(hn::MulAdd(rgbw, weight, hn::Load(d, out)), d, out);
    }
  }
}

template <typename Real>
HWY_INLINE void AddPlanar(const Real* HWY_RESTRICT colour, const Real* HWY_RESTRICT weights, int count,
                          std::size_t plane, Real* HWY_RESTRICT out) {
  const hn::ScalableTag<Real> d;
  constexpr int lanes = static_cast<int>(hn::MaxLanes(d));
  const auto r = hn::Set(d, colour[0]), g = hn::Set(d, colour[1]), b = hn::Set(d, colour[2]);
  for (int i = 0; i < count; i += lanes, out += lanes) {
    const auto weight = hn::LoadU(d, weights + i);
    hn::Store(hn::MulAdd(r, weight, hn::Load(d, out)), d, out);
    hn::Store(hn::MulAdd(g, weight, hn::Load(d, out + plane)), d, out + plane);
    hn::Store(hn::MulAdd(b, weight, hn::Load(d, out + 2 * plane)), d, out + 2 * plane);
    hn::Store(hn::Add(weight, hn::Load(d, out + 3 * plane)), d, out + 3 * plane);
  }
}

template <typename Real, Layout layout>
HWY_INLINE void ScatterRow(const std::vector<NaiveKernel<Real>>& kernels, const std::int16_t* index,
                           const Real* colours, int width, int y, const NaiveBand<Real>& band) {
  constexpr int lanes = static_cast<int>(hn::MaxLanes(hn::ScalableTag<Real>()));
  constexpr int pixels = layout == Layout::planar ? lanes : std::max(1, lanes / 4);  // a vector
  for (int x = 0; x < width; ++x) {
    const NaiveKernel<Real>& kernel = kernels[static_cast<std::size_t>(std::abs(index[x]))];
    HWY_ALIGN Real colour[std::max(4, lanes)];
    for (int i = 0; i < std::max(4, lanes); ++i) colour[i] = colours[x * 4 + i % 4];
    const int first = std::max(-kernel.radius_y, band.y0 - y), last = std::min(kernel.radius_y, band.y1 - 1 - y);
    for (int dy = first; dy <= last; ++dy) {
      const auto& row = kernel.rows[static_cast<std::size_t>(dy + kernel.radius_y)];
      const int column = band.pad + x + row.dx, lead = column & (pixels - 1);
      const Real* weights = kernel.weights.data() + row.first - lead;
      Real* sums = band.sums + static_cast<std::size_t>(y + dy - band.y0) * band.row;
      if constexpr (layout == Layout::planar) {
        AddPlanar(colour, weights, row.count + lead, band.plane, sums + (column - lead));
      } else {
        AddInterleaved(colour, weights, row.count + lead, sums + (column - lead) * 4);
      }
    }
  }
}

template <typename Real>
HWY_INLINE void Row(Layout layout, const std::vector<NaiveKernel<Real>>& kernels, const std::int16_t* index,
                    const Real* colours, int width, int y, const NaiveBand<Real>& band) {
  if (layout == Layout::planar) {
    ScatterRow<Real, Layout::planar>(kernels, index, colours, width, y, band);
  } else {
    ScatterRow<Real, Layout::interleaved>(kernels, index, colours, width, y, band);
  }
}

void RowFloat(Layout layout, const std::vector<NaiveKernel<float>>& kernels, const std::int16_t* index,
              const float* colours, int width, int y, const NaiveBand<float>& band) {
  Row(layout, kernels, index, colours, width, y, band);
}

void RowDouble(Layout layout, const std::vector<NaiveKernel<double>>& kernels, const std::int16_t* index,
               const double* colours, int width, int y, const NaiveBand<double>& band) {
  Row(layout, kernels, index, colours, width, y, band);
}

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace pullfocus::cli::bench
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pullfocus::cli::bench {

HWY_EXPORT(RowFloat);
HWY_EXPORT(RowDouble);

template <>
void naive_scatter_row(Layout layout, const std::vector<NaiveKernel<float>>& kernels, const std::int16_t* index,
                       const float* colours, int width, int y, const NaiveBand<float>& band) {
  HWY_DYNAMIC_DISPATCH(RowFloat)(layout, kernels, index, colours, width, y, band);
}

template <>
void naive_scatter_row(Layout layout, const std::vector<NaiveKernel<double>>& kernels, const std::int16_t* index,
                       const double* colours, int width, int y, const NaiveBand<double>& band) {
  HWY_DYNAMIC_DISPATCH(RowDouble)(layout, kernels, index, colours, width, y, band);
}

}  // namespace pullfocus::cli::bench
#endif
