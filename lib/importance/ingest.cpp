#include "importance/ingest.h"

#include <algorithm>

#include "scatter/state.h"

namespace pullfocus {

void FrameFindings::add(const FrameFindings& other) noexcept {
  colour.not_finite += other.colour.not_finite;
  colour.clamped += other.colour.clamped;
  depth += other.depth;
  coc_clamped += other.coc_clamped;
  content = unite(content, other.content);
  content_index = std::max(content_index, other.content_index);
}

template <SampleType type>
void SegmentIngest<type>::indices(int x, int y, int n, std::int16_t* out, FrameFindings& findings) const noexcept {
  const SegmentFindings segment = signed_indices(to_index_, depths(x, y), n, out);
  if (has_mask_) [[unlikely]]
    hold_out(x, y, n, out);
  add(x, y, n, segment, out, findings);
}

template <SampleType type>
SegmentDifference SegmentIngest<type>::compare(int x, int y, int n, const Pixel<type>* old_colours,
                                               const std::int16_t* old_index, RememberedDepths* remembered,
                                               std::int16_t* out, FrameFindings& findings) const noexcept {
  const float* known = remembered != nullptr ? remembered->known(x, y) : nullptr;
  const SegmentPair<type> pair{depths(x, y), colours(x, y), old_colours, old_index, n, known};
  SegmentDifference difference;
  const SegmentFindings segment = pullfocus::compare<type>(to_index_, pair, out, difference);
  if (difference.known) {
    add(x, y, n, remembered->findings(x, y), old_index, findings);
    return difference;
  }
  if (has_mask_) [[unlikely]] {
    hold_out(x, y, n, out);
    difference.index = 0;
    for (int i = 0; i < n; ++i) difference.index |= std::uint64_t{out[i] != old_index[i]} << i;
  }
  add(x, y, n, segment, out, findings);
  if (remembered != nullptr) remembered->take({pair.depth, static_cast<std::size_t>(n)}, x, y, difference, segment);
  return difference;
}

template <SampleType type>
int SegmentIngest<type>::unchanged(int x, int y, int most, const Pixel<type>* old_colours,
                                   const std::int16_t* old_index, const RememberedDepths& remembered,
                                   FrameFindings& findings) const noexcept {
  const int known = remembered.known_from(x, y, most);
  if (known == 0) return 0;
  const SegmentPair<type> first{depths(x, y), colours(x, y), old_colours,
                                old_index,    kTileWidth,    remembered.known(x, y)};
  const int unchanged = unchanged_segments<type>(first, known);
  extend_content(x, y, unchanged * kTileWidth, findings);
  for (int s = 0; s < unchanged; ++s) {
    const int at = s * kTileWidth;
    const SegmentFindings segment = remembered.findings(x + at, y);
    findings.coc_clamped += segment.clamped;
    raise_content_index(x + at, y, kTileWidth, segment.largest, old_index + at, findings);
  }
  return unchanged;
}

template <SampleType type>
void SegmentIngest<type>::hold_out(int x, int y, int n, std::int16_t* indices) const noexcept {
  const float* mask = frame_.mask.row(window_.y0 + y) + x;
  for (int i = 0; i < n; ++i) indices[i] = is_held_out(mask[i]) ? kHeldOut : indices[i];
}

template <SampleType type>
void SegmentIngest<type>::add(int x, int y, int n, const SegmentFindings& segment, const std::int16_t* indices,
                              FrameFindings& findings) const noexcept {
  findings.coc_clamped += segment.clamped;
  if (segment.suspect) count_suspects(x, y, n, findings);
  extend_content(x, y, n, findings);
  raise_content_index(x, y, n, segment.largest, indices, findings);
}

template <SampleType type>
void SegmentIngest<type>::count_suspects(int x, int y, int n, FrameFindings& findings) const noexcept {
  const float* depth = depths(x, y);
  const Pixel<type>* pixels = colours(x, y);
  for (int i = 0; i < n; ++i) {
    findings.depth += is_suspect(to_index_.coc.kind, depth[i], sample_value(sanitiser_(pixels[i]).rgba[3]) > 0.f);
  }
}

template <SampleType type>
bool SegmentIngest<type>::has_content(int x, int y) const noexcept {
  const auto& rgba = colours(x, y)->rgba;
  const bool coloured = (rgba[0] | rgba[1] | rgba[2]) != 0 || (frame_.has_alpha && rgba[3] != 0);
  return coloured || !is_background(to_index_.coc.kind, *depths(x, y));
}

template <SampleType type>
void SegmentIngest<type>::extend_content(int x, int y, int n, FrameFindings& findings) const noexcept {
  Window& bounds = findings.content;
  if (x >= bounds.x0 && x + n <= bounds.x1 && y >= bounds.y0 && y < bounds.y1) return;
  int first = 0, last = n - 1;
  while (first <= last && !has_content(x + first, y)) ++first;
  if (first > last) return;
  while (!has_content(x + last, y)) --last;
  bounds = unite(bounds, {x + first, y, x + last + 1, y + 1});
}

template <SampleType type>
void SegmentIngest<type>::raise_content_index(int x, int y, int n, int largest, const std::int16_t* indices,
                                              FrameFindings& findings) const noexcept {
  if (largest <= findings.content_index) return;
  for (int i = 0; i < n; ++i) {
    const int index = reach_index(indices[i]);
    if (index > findings.content_index && has_content(x + i, y)) findings.content_index = index;
  }
}

template class SegmentIngest<SampleType::half>;
template class SegmentIngest<SampleType::float32>;

}  // namespace pullfocus
