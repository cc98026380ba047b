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

template <typename Real>
HWY_INLINE void BySource(const std::vector<NaiveKernel<Real>>& kernels, const std::int16_t* index, const Real* colours,
                         int width, int y, const NaiveBand<Real>& band) {
  constexpr int lanes = static_cast<int>(hn::MaxLanes(hn::ScalableTag<Real>())), repeated = std::max(4, lanes);
  constexpr int pixels = std::max(1, lanes / 4);  // a vector
  for (int x = 0; x < width; ++x) {
    const NaiveKernel<Real>& kernel = kernels[static_cast<std::size_t>(std::abs(index[x]))];
    HWY_ALIGN Real colour[repeated];
    for (int i = 0; i < repeated; ++i) colour[i] = colours[x * 4 + i % 4];
    const int first = std::max(-kernel.radius_y, band.y0 - y), last = std::min(kernel.radius_y, band.y1 - 1 - y);
    for (int dy = first; dy <= last; ++dy) {
      const auto& row = kernel.rows[static_cast<std::size_t>(dy + kernel.radius_y)];
      const int column = band.pad + x + row.dx, lead = column & (pixels - 1);
      Real* sums = band.sums + static_cast<std::size_t>(y + dy - band.y0) * band.row;
      AddInterleaved(colour, kernel.weights.data() + row.first - lead, row.count + lead, sums + (column - lead) * 4);
    }
  }
}

template <typename Real>
HWY_INLINE void ByRow(const std::vector<NaiveKernel<Real>>& kernels, const std::int16_t* index, const Real* colours,
                      int width, int y, const NaiveBand<Real>& band) {
  constexpr int lanes = static_cast<int>(hn::MaxLanes(hn::ScalableTag<Real>()));
  constexpr int group = 32;  // sources
  const NaiveKernel<Real>* kernel[group];
  for (int x0 = 0; x0 < width; x0 += group) {
    const int n = std::min(group, width - x0);
    int reach = 0;
    for (int i = 0; i < n; ++i) {
      kernel[i] = &kernels[static_cast<std::size_t>(std::abs(index[x0 + i]))];
      reach = std::max(reach, kernel[i]->radius_y);
    }
    for (int to = std::max(band.y0, y - reach); to < std::min(band.y1, y + reach + 1); ++to) {
      Real* sums = band.sums + static_cast<std::size_t>(to - band.y0) * band.row;
      for (int i = 0; i < n; ++i) {
        if (std::abs(to - y) > kernel[i]->radius_y) continue;
        const auto& row = kernel[i]->rows[static_cast<std::size_t>(to - y + kernel[i]->radius_y)];
        const int column = band.pad + x0 + i + row.dx, lead = column & (lanes - 1);
        AddPlanar(colours + (x0 + i) * 4, kernel[i]->weights.data() + row.first - lead, row.count + lead, band.plane,
                  sums + (column - lead));
      }
    }
  }
}

template <typename Real>
HWY_INLINE void Row(Way way, const std::vector<NaiveKernel<Real>>& kernels, const std::int16_t* index,
                    const Real* colours, int width, int y, const NaiveBand<Real>& band) {
  if (way == Way::by_row) {
    ByRow(kernels, index, colours, width, y, band);
  } else {
    BySource(kernels, index, colours, width, y, band);
  }
}

void RowFloat(Way way, const std::vector<NaiveKernel<float>>& kernels, const std::int16_t* index, const float* colours,
              int width, int y, const NaiveBand<float>& band) {
  Row(way, kernels, index, colours, width, y, band);
}

void RowDouble(Way way, const std::vector<NaiveKernel<double>>& kernels, const std::int16_t* index,
               const double* colours, int width, int y, const NaiveBand<double>& band) {
  Row(way, kernels, index, colours, width, y, band);
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
void naive_scatter_row(Way way, const std::vector<NaiveKernel<float>>& kernels, const std::int16_t* index,
                       const float* colours, int width, int y, const NaiveBand<float>& band) {
  HWY_DYNAMIC_DISPATCH(RowFloat)(way, kernels, index, colours, width, y, band);
}

template <>
void naive_scatter_row(Way way, const std::vector<NaiveKernel<double>>& kernels, const std::int16_t* index,
                       const double* colours, int width, int y, const NaiveBand<double>& band) {
  HWY_DYNAMIC_DISPATCH(RowDouble)(way, kernels, index, colours, width, y, band);
}

}  // namespace pullfocus::cli::bench
#endif
