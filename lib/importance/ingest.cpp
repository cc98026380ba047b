#include "importance/ingest.h"

#include <cmath>

namespace pullfocus {

void FrameFindings::add(const FrameFindings& other) noexcept {
  colour.not_finite += other.colour.not_finite;
  colour.clamped += other.colour.clamped;
  depth += other.depth;
  coc_clamped += other.coc_clamped;
  content = unite(content, other.content);
  content_index = std::max(content_index, other.content_index);
}

namespace {

// Signed diameters of n depths, background resolved. Branch-free so that it vectorises.
void diameters(const CocFunction& coc, const float* depth, int n, float* out) noexcept {
  if (coc.kind == DepthKind::coc) {
    for (int i = 0; i < n; ++i) out[i] = std::fabs(depth[i]) < INFINITY ? depth[i] : 0.f;
    return;
  }
  for (int i = 0; i < n; ++i) {
    const float z = depth[i];
    const bool surface = (z > 0.f) & (z < planar_background_from);
    const float inverse = 1.0f / (surface ? z : INFINITY);
    out[i] = coc.scale * (coc.inverse_focus - inverse);
  }
}

}  // namespace

template <SampleType type>
void SegmentIngest<type>::indices(int x, int y, int n, std::int16_t* out, FrameFindings& findings) const noexcept {
  const float* depth = frame_.depth.row(window_.y0 + y) + x;
  float c[kTileWidth];
  diameters(coc_, depth, n, c);

  std::int32_t cell[kTileWidth];
  int suspect = 0, clamped = 0;
  for (int i = 0; i < n; ++i) {
    cell[i] = table_.cell(c[i]);
    clamped += std::fabs(c[i]) > table_.max_diameter();
    suspect += !(depth[i] > 0.f);
  }
  const std::int16_t* cells = table_.cells();
  for (int i = 0; i < n; ++i) {
    const std::int16_t magnitude = cells[cell[i]];
    out[i] = c[i] < 0.f ? static_cast<std::int16_t>(-magnitude) : magnitude;
  }
  findings.coc_clamped += clamped;
  if (suspect != 0) count_suspects(x, y, n, findings);
}

template <SampleType type>
void SegmentIngest<type>::count_suspects(int x, int y, int n, FrameFindings& findings) const noexcept {
  const float* depth = frame_.depth.row(window_.y0 + y) + x;
  const Pixel<type>* pixels = colours(x, y);
  for (int i = 0; i < n; ++i) {
    findings.depth += is_suspect(coc_.kind, depth[i], sample_value(sanitiser_(pixels[i]).rgba[3]) > 0.f);
  }
}

template <SampleType type>
bool SegmentIngest<type>::has_content(int x, int y) const noexcept {
  const auto& rgba = colours(x, y)->rgba;
  const bool coloured = (rgba[0] | rgba[1] | rgba[2]) != 0 || (frame_.has_alpha && rgba[3] != 0);
  return coloured || !is_background(coc_.kind, frame_.depth.row(window_.y0 + y)[x]);
}

template <SampleType type>
void SegmentIngest<type>::content(int x, int y, int n, const std::int16_t* indices,
                                  FrameFindings& findings) const noexcept {
  int largest = 0;
  for (int i = 0; i < n; ++i) largest = std::max(largest, std::abs(static_cast<int>(indices[i])));
  Window& bounds = findings.content;
  // Where neither the bounds nor the largest index can grow there is nothing to look for.
  const bool inside = x >= bounds.x0 && x + n <= bounds.x1 && y >= bounds.y0 && y < bounds.y1;
  if (!inside) {
    int first = 0, last = n - 1;
    while (first <= last && !has_content(x + first, y)) ++first;
    if (first > last) return;
    while (!has_content(x + last, y)) --last;
    bounds = unite(bounds, {x + first, y, x + last + 1, y + 1});
  }
  if (largest <= findings.content_index) return;
  for (int i = 0; i < n; ++i) {
    const int index = std::abs(static_cast<int>(indices[i]));
    if (index > findings.content_index && has_content(x + i, y)) findings.content_index = index;
  }
}

template class SegmentIngest<SampleType::half>;
template class SegmentIngest<SampleType::float32>;

}  // namespace pullfocus
