#include "scatter/edge_pairs.h"

#include <algorithm>

namespace pullfocus {

EdgePairs pairs_of(const Kernel& kernel) {
  EdgePairs plan;
  plan.radius_y = kernel.radius_y;
  const auto end_row = [&plan] {
    for (auto& list : plan.of_columns) list.row_begin.push_back(static_cast<std::uint32_t>(list.pairs.size()));
  };
  end_row();
  for (int dy = -kernel.radius_y; dy <= kernel.radius_y; ++dy) {
    const std::span<const KernelEdge> edges = kernel.row(dy);
    std::uint8_t level = 0;
    for (std::size_t i = 0; i < edges.size();) {
      const KernelEdge& edge = edges[i++];
      LevelPair kind{level, kernel.level_behind(edge), 0};
      kind.second = kind.first;
      const bool is_pair = i < edges.size() && edges[i].dx == edge.dx + 1;
      if (is_pair) kind.second = kernel.level_behind(edges[i++]);
      level = kind.second;
      const auto at =
          static_cast<std::size_t>(std::find(plan.kinds.begin(), plan.kinds.end(), kind) - plan.kinds.begin());
      if (at == EdgePairs::kMostKinds) return {};
      if (at == plan.kinds.size()) plan.kinds.push_back(kind);
      plan.of_columns[is_pair].pairs.push_back({edge.dx, static_cast<std::int16_t>(dy), static_cast<std::uint8_t>(at)});
    }
    end_row();
  }
  return plan;
}

}  // namespace pullfocus
