#include "camera/mixed_depth.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace pullfocus {

namespace {

constexpr float kInvalid = std::numeric_limits<float>::quiet_NaN();
constexpr float kRelativeGap = 0.05f;    // of inverse depth, between two surfaces
constexpr float kCocGap = 1;             // px
constexpr int kZone = 3;                 // mixed pixels between two surfaces, at most
constexpr float kSmooth = 1.f / 8;       // of the gap: a surface's own steps are smaller
constexpr float kCurvature = 2.5f;       // times a surface's own step, for every pixel from it
constexpr float kLeastShare = 1.f / 16;  // of either surface in a mixture
constexpr float kLeastEmpty = 1e-4f;     // share of an empty value >= 1e9, which outweighs every depth
constexpr float kAlphaTolerance = 0.1f;
constexpr float kLeastTorn = 1.f / 2;  // of the gap: the neighbours of a mixed pixel differ by more

struct Direction {
  int dx, dy;
};
constexpr Direction kDirections[] = {{1, 0}, {0, 1}, {1, 1}, {1, -1}};

bool is_empty(DepthKind kind, float stored) noexcept {
  return std::isfinite(stored) && stored >= 0 && is_background(kind, stored);
}

static_assert(MixedDepth::kReach == kZone + 1);

// Linear over the picture for planes; 0 where empty.
float disparity(DepthKind kind, float stored) noexcept {
  if (!std::isfinite(stored) || (kind == DepthKind::planar && stored < 0)) return kInvalid;
  if (kind == DepthKind::coc) return stored;
  return stored > 0 && stored < planar_background_from ? 1 / stored : 0;
}

// Least distance of two surfaces, the larger magnitude being given.
float least_gap(DepthKind kind, float disparity) noexcept {
  return kind == DepthKind::coc ? kCocGap : kRelativeGap * disparity;
}

}  // namespace

struct MixedDepth::Line {
  const MixedDepth& depths;
  int x, y;
  Direction d;

  bool inside(int k) const noexcept {
    const int px = x + k * d.dx, py = y + k * d.dy;
    return px >= 0 && px < depths.width_ && py >= 0 && py < depths.height_;
  }
  std::size_t at(int k) const noexcept { return depths.at(x + k * d.dx, y + k * d.dy); }
  float disparity(int k) const noexcept { return depths.disparity_[at(k)]; }
  float stored(int k) const noexcept { return depths.stored(x + k * d.dx, y + k * d.dy); }
  bool empty(int k) const noexcept { return is_empty(depths.kind_, stored(k)); }
};

struct MixedDepth::Mixture {
  int from = 0;  // pixels along the line; 0: it is not mixed
  float gap = 0;
};

MixedDepth::MixedDepth(const Frame& frame, DepthKind kind)
    : frame_(frame),
      kind_(kind),
      width_(frame.window().width()),
      height_(frame.window().height()),
      disparity_(frame.window().pixels()) {
  tbb::parallel_for(0, height_, [&](int y) {
    const float* depth = frame.depth.row(frame.window().y0 + y);
    float* out = &disparity_[at(0, y)];
    for (int x = 0; x < width_; ++x) out[x] = disparity(kind, depth[x]);
  });
}

void MixedDepth::set(int x, int y, float depth) noexcept { disparity_[at(x, y)] = disparity(kind_, depth); }

void MixedDepth::torn(int y, std::vector<int>& columns) const {
  // Plain loops over local pointers, which compilers turn into vectors.
  std::vector<std::int32_t> is_torn(static_cast<std::size_t>(width_));
  std::int32_t* const out = is_torn.data();
  const float least = kLeastTorn * (kind_ == DepthKind::coc ? kCocGap : 0);
  const float relative = kLeastTorn * (kind_ == DepthKind::coc ? 0 : kRelativeGap);
  for (const Direction& d : kDirections) {
    if (y - d.dy < 0 || y - d.dy >= height_ || y + d.dy < 0 || y + d.dy >= height_) continue;
    const int n = width_ - 2 * d.dx;
    const float* const a = &disparity_[at(0, y - d.dy)];
    const float* const b = a + (at(0, y + d.dy) - at(0, y - d.dy)) + 2 * d.dx;
    for (int x = 0; x < n; ++x) {
      const float size = a[x] > b[x] ? a[x] : b[x];
      out[x + d.dx] |= std::fabs(a[x] - b[x]) > least + relative * size ? 1 : 0;
    }
  }
  columns.clear();
  for (int x = 0; x < width_; ++x) {
    if (out[x] != 0) columns.push_back(x);
  }
}

std::optional<MixedDepth::Change> MixedDepth::replacement(int x, int y) const noexcept {
  if (std::isnan(disparity_[at(x, y)])) return std::nullopt;
  Direction directions[std::size(kDirections)];
  int count = 0;
  for (const Direction& d : kDirections) {
    if (may_lie_between({*this, x, y, d})) directions[count++] = d;
  }
  for (int zone = 1; count > 0 && zone <= kZone; ++zone) {
    Mixture best;
    Direction along{};
    for (int i = 0; i < count; ++i) {
      for (int a = 1; a <= zone; ++a) {
        const Mixture found = mixture({*this, x, y, directions[i]}, a, zone + 1 - a);
        if (found.from != 0 && found.gap > best.gap) {
          best = found;
          along = directions[i];
        }
      }
    }
    if (best.from != 0) return Change{x, y, x + best.from * along.dx, y + best.from * along.dy};
  }
  return std::nullopt;
}

// Necessary for a mixture, and quick to refuse: depth neither rises to the pixel and falls again nor the reverse.
bool MixedDepth::may_lie_between(const Line& line) const noexcept {
  if (!line.inside(-2) || !line.inside(2)) return false;
  const float before = line.stored(-1), own = line.stored(0), after = line.stored(1);
  if (!((before <= own && own <= after) || (before >= own && own >= after))) return false;
  const float least = least_gap(kind_, line.disparity(0));
  const auto clear = [&](int step) {
    for (int k = 1; k <= kZone && line.inside(step * k); ++k) {
      if (line.empty(step * k) || std::fabs(line.disparity(step * k) - line.disparity(0)) > least) return true;
    }
    return false;
  };
  return clear(-1) && clear(1);
}

bool MixedDepth::continues_surface(int x, int y, const std::vector<std::uint8_t>& candidate) const noexcept {
  for (const Direction& d : kDirections) {
    const Line line{*this, x, y, d};
    for (const int k : {-1, 1}) {
      if (!line.inside(2 * k) || candidate[line.at(k)] || candidate[line.at(2 * k)]) continue;
      if (line.empty(k) || line.empty(2 * k)) continue;
      const float step = line.disparity(0) - line.disparity(k), own = line.disparity(k) - line.disparity(2 * k);
      if (std::fabs(step) <= kCurvature * std::fabs(own) && step * own >= 0) return true;
    }
  }
  return false;
}

int MixedDepth::sharp_steps(int x, int y) const noexcept {
  int steps = 0;
  for (const Direction& d : {kDirections[0], kDirections[1]}) {
    const Line line{*this, x, y, d};
    if (!line.inside(-1) || !line.inside(2)) continue;
    const float t = line.disparity(0), next = line.disparity(1), gap = std::fabs(t - next);
    steps += gap > 0 && gap >= least_gap(kind_, std::max(t, next)) &&
             std::fabs(t - line.disparity(-1)) <= kSmooth * gap && std::fabs(next - line.disparity(2)) <= kSmooth * gap;
  }
  return steps;
}

// Between the surfaces that begin a pixels back and b pixels ahead.
MixedDepth::Mixture MixedDepth::mixture(const Line& line, int a, int b) const noexcept {
  if (!line.inside(-a - 1) || !line.inside(b + 1)) return {};
  if (std::isnan(line.disparity(-a - 1)) || std::isnan(line.disparity(b + 1))) return {};
  const bool empty_a = line.empty(-a), empty_b = line.empty(b);
  if (empty_a && empty_b) return {};
  if (empty_a) return with_empty(line, b, -a);
  if (empty_b) return with_empty(line, -a, b);
  return of_surfaces(line, a, b);
}

MixedDepth::Mixture MixedDepth::of_surfaces(const Line& line, int a, int b) const noexcept {
  const float ta = line.disparity(-a), tb = line.disparity(b), t = line.disparity(0);
  const float gap = std::fabs(ta - tb);
  if (!(gap >= least_gap(kind_, std::max(ta, tb)))) return {};
  const float step_a = std::fabs(ta - line.disparity(-a - 1)), step_b = std::fabs(tb - line.disparity(b + 1));
  if (!(step_a <= kSmooth * gap && step_b <= kSmooth * gap)) return {};
  const float least = least_gap(kind_, t);
  if (!(std::fabs(t - ta) > std::max(least, kCurvature * static_cast<float>(a) * step_a))) return {};
  if (!(std::fabs(t - tb) > std::max(least, kCurvature * static_cast<float>(b) * step_b))) return {};
  for (int k = -a; k < b; ++k) {
    const float step = line.disparity(k + 1) - line.disparity(k);
    if (!(ta < tb ? step >= 0 : step <= 0)) return {};
  }
  const float share = (line.stored(0) - line.stored(b)) / (line.stored(-a) - line.stored(b));
  if (!(share > kLeastShare && share < 1 - kLeastShare)) return {};
  return {share >= 0.5f ? -a : b, gap};
}

// Between a surface and empty pixels, `surface` and `empty` pixels along the line.
MixedDepth::Mixture MixedDepth::with_empty(const Line& line, int surface, int empty) const noexcept {
  const int away = surface > 0 ? 1 : -1;
  const float e = line.stored(empty), s = line.stored(surface);
  if (line.stored(empty - away) != e || line.empty(surface + away)) return {};
  const float gap = line.disparity(surface);
  const float step = std::fabs(gap - line.disparity(surface + away));
  if (!(step <= kSmooth * gap)) return {};
  for (int k = empty; k != surface; k += away) {
    const float change = line.stored(k + away) - line.stored(k);
    if (!(e < s ? change >= 0 : change <= 0)) return {};
  }
  const float alpha = frame_.colour.get(frame_.window().x0 + line.x, frame_.window().y0 + line.y, 3);
  const bool opaque = !frame_.has_alpha || !(alpha < 1);
  const float share = (line.stored(0) - e) / (s - e);
  // The slightest part of a surface beside 0 looks very near, the slightest part of 1e10 very far.
  const float least_share = e == 0 ? 0 : kLeastShare;
  const float least_empty = e >= planar_background_from ? kLeastEmpty : opaque ? kLeastShare : kLeastShare / 4;
  if (!(share > least_share && 1 - share > least_empty)) return {};
  const float slope = kCurvature * static_cast<float>(std::abs(surface)) * step;
  if (e == 0 && !(line.disparity(0) - gap > slope)) return {};
  constexpr float surest = std::numeric_limits<float>::infinity();
  if (opaque) return {share >= 0.5f ? surface : empty, surest};
  if (!(std::fabs(share - alpha) <= kAlphaTolerance)) return {};
  return {surface, surest};
}

}  // namespace pullfocus
