#include "camera/depth_repair.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <numeric>
#include <vector>

#include "camera/mixed_depth.h"

namespace pullfocus {

namespace {

using Change = MixedDepth::Change;

constexpr int kRounds = 2;  // pixels that a surface may lead on to, one after the other

// The mixed pixels, found again after changes without looking at every row again.
class Search {
 public:
  explicit Search(MixedDepth& depths)
      : depths_(depths),
        stale_(static_cast<std::size_t>(depths.height()), 1),
        candidates_(stale_.size()),
        sharp_(stale_.size()),
        is_candidate_(stale_.size() * static_cast<std::size_t>(depths.width())) {}

  std::vector<Change> mixed() {
    for_rows([&](std::size_t y) {
      if (stale_[y]) search_row(y);
    });
    std::fill(stale_.begin(), stale_.end(), std::uint8_t{0});
    std::vector<std::vector<Change>> rows = candidates_;
    mark(rows, 1);
    for (int round = 0; round < kRounds; ++round) {
      std::vector<std::vector<Change>> left = rows;
      for_rows([&](std::size_t y) {
        std::erase_if(left[y], [&](const Change& c) { return depths_.continues_surface(c.x, c.y, is_candidate_); });
      });
      mark(rows, 0);
      mark(left, 1);
      rows = std::move(left);
    }
    mark(rows, 0);
    std::vector<Change> all;
    for (const auto& row : rows) all.insert(all.end(), row.begin(), row.end());
    return all;
  }

  std::int64_t sharp() const { return std::accumulate(sharp_.begin(), sharp_.end(), std::int64_t{0}); }

  void changed(const Change& c, float depth) {
    depths_.set(c.x, c.y, depth);
    const int first = std::max(c.y - MixedDepth::kReach, 0);
    const int last = std::min(c.y + MixedDepth::kReach, depths_.height() - 1);
    for (int y = first; y <= last; ++y) stale_[static_cast<std::size_t>(y)] = 1;
  }

 private:
  template <typename Body>
  void for_rows(Body&& body) const {
    tbb::parallel_for(std::size_t{0}, candidates_.size(), body);
  }

  void search_row(std::size_t row) {
    const int y = static_cast<int>(row);
    std::vector<int> columns;
    depths_.torn(y, columns);
    candidates_[row].clear();
    sharp_[row] = 0;
    for (const int x : columns) {
      sharp_[row] += depths_.sharp_steps(x, y);
      if (const auto change = depths_.replacement(x, y)) candidates_[row].push_back(*change);
    }
  }

  void mark(const std::vector<std::vector<Change>>& rows, std::uint8_t value) {
    for (const auto& row : rows) {
      for (const Change& c : row) is_candidate_[depths_.at(c.x, c.y)] = value;
    }
  }

  MixedDepth& depths_;
  std::vector<std::uint8_t> stale_;  // rows
  std::vector<std::vector<Change>> candidates_;
  std::vector<std::int64_t> sharp_;
  std::vector<std::uint8_t> is_candidate_;
};

}  // namespace

DepthEdges find_depth_edges(const Frame& frame, DepthKind kind) {
  MixedDepth depths(frame, kind);
  Search search(depths);
  const auto mixed = static_cast<std::int64_t>(search.mixed().size());
  return {mixed, search.sharp()};
}

std::int64_t repair_depth(Frame& frame, DepthKind kind) {
  constexpr int most_passes = 16;
  const Window& w = frame.window();
  MixedDepth depths(frame, kind);
  Search search(depths);
  std::vector<std::uint8_t> touched(w.pixels()), is_mixed(w.pixels());
  for (int pass = 0; pass < most_passes; ++pass) {
    const std::vector<Change> mixed = search.mixed();
    for (const Change& c : mixed) is_mixed[depths.at(c.x, c.y)] = 1;
    bool any = false;
    for (const Change& c : mixed) {
      // What is to be replaced itself is no model for others: those wait for the next pass.
      if (is_mixed[depths.at(c.from_x, c.from_y)]) continue;
      const float depth = frame.depth.at(w.x0 + c.from_x, w.y0 + c.from_y);
      frame.depth.at(w.x0 + c.x, w.y0 + c.y) = depth;
      search.changed(c, depth);
      touched[depths.at(c.x, c.y)] = 1;
      any = true;
    }
    if (!any) break;
    for (const Change& c : mixed) is_mixed[depths.at(c.x, c.y)] = 0;
  }
  return std::count(touched.begin(), touched.end(), 1);
}

}  // namespace pullfocus
