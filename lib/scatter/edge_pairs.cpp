#include "scatter/edge_pairs.h"

#include <algorithm>

namespace pullfocus {

EdgePairs pairs_of(const Kernel& kernel) {
  EdgePairs plan;
  plan.radius_y = kernel.radius_y;
  plan.row_begin.push_back(0);
  for (int dy = -kernel.radius_y; dy <= kernel.radius_y; ++dy) {
    const std::span<const KernelEdge> edges = kernel.row(dy);
    std::uint8_t level = 0;
    for (std::size_t i = 0; i < edges.size();) {
      const KernelEdge& edge = edges[i++];
      LevelPair kind{level, kernel.level_behind(edge), 0};
      kind.second = kind.first;
      if (i < edges.size() && edges[i].dx == edge.dx + 1) kind.second = kernel.level_behind(edges[i++]);
      level = kind.second;
      const auto at =
          static_cast<std::size_t>(std::find(plan.kinds.begin(), plan.kinds.end(), kind) - plan.kinds.begin());
      if (at == EdgePairs::kMostKinds) return {};
      if (at == plan.kinds.size()) plan.kinds.push_back(kind);
      plan.pairs.push_back({edge.dx, static_cast<std::int16_t>(dy), static_cast<std::uint8_t>(at)});
    }
    plan.row_begin.push_back(static_cast<std::uint32_t>(plan.pairs.size()));
  }
  return plan;
}

}  // namespace pullfocus
