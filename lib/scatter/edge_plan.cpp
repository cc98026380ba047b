#include "scatter/edge_plan.h"

#include <algorithm>
#include <cstdlib>
#include <iterator>
#include <stdexcept>
#include <utility>

namespace pullfocus {

namespace {

class Planner {
 public:
  // Value rows 0.. are those of all levels but the outside; every kernel adds its own.
  std::size_t add_levels(const Kernel& kernel) {
    const std::size_t first = plan_.weights.size();
    for (std::size_t k = 1; k < kernel.levels.size(); ++k) {
      plan_.weights.push_back(static_cast<double>(kernel.levels[k]));
    }
    plan_.radius_y = std::max(plan_.radius_y, kernel.radius_y);
    return first;
  }

  // After the levels of all kernels. `first`: the value row of the kernel's level 1.
  std::vector<std::uint8_t> add_steps(const Kernel& kernel, std::size_t first) {
    std::vector<std::uint8_t> rows;
    for (const KernelStep& step : kernel.steps) {
      const auto high = static_cast<std::uint8_t>(first + step.high - 1);
      if (step.low == 0) {
        rows.push_back(high);
      } else {
        rows.push_back(static_cast<std::uint8_t>(plan_.weights.size() + plan_.differences.size()));
        plan_.differences.push_back({high, static_cast<std::uint8_t>(first + step.low - 1)});
      }
    }
    return rows;
  }

  // After the steps of all kernels.
  void add_edges(const Kernel& kernel, const std::vector<std::uint8_t>& rows, int dy) {
    if (std::abs(dy) > kernel.radius_y) return;
    for (const KernelEdge& edge : kernel.row(dy)) edges_[edge.rising].push_back({edge.dx, rows[edge.step]});
  }

  // Of both kernels at once.
  void end_row(int dy) {
    for (const bool rising : {false, true}) {
      std::vector<Edge>& edges = edges_[rising];
      std::stable_sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) { return a.dx < b.dx; });
      merge(edges);
      for (std::size_t i = 0; i < edges.size();) i = add_chain(edges, i, dy, rising);
      edges.clear();
    }
    for (auto& lists : plan_.chains) {
      for (ChainList& list : lists) list.row_begin.push_back(static_cast<std::uint32_t>(list.chains.size()));
    }
  }

  EdgePlan plan() {
    const std::size_t zeros = plan_.weights.size() + plan_.differences.size() + plan_.sums.size();
    for (auto& lists : plan_.chains) {
      for (ChainList& list : lists) {
        for (EdgeChain& chain : list.chains) {
          std::replace(std::begin(chain.rows), std::end(chain.rows), kZeros, static_cast<std::uint8_t>(zeros));
        }
      }
    }
    return std::move(plan_);
  }

  explicit Planner(std::size_t of_plus) {
    plan_.of_plus = of_plus;
    for (auto& lists : plan_.chains) {
      for (ChainList& list : lists) list.row_begin.push_back(0);
    }
  }

 private:
  struct Edge {
    int dx;
    std::uint8_t row;
  };
  static constexpr std::uint8_t kZeros = kMostValueRows - 1;  // until their number is known

  EdgePlan plan_;
  std::vector<Edge> edges_[2];  // of one row, by sign

  // Two edges at one column become one of a summed row, as long as there is room for rows.
  void merge(std::vector<Edge>& edges) {
    std::size_t n = 0;
    for (std::size_t i = 0; i < edges.size(); ++i) {
      const bool same_column = n > 0 && edges[n - 1].dx == edges[i].dx;
      if (!same_column || !sum(edges[n - 1].row, edges[i].row, edges[n - 1].row)) edges[n++] = edges[i];
    }
    edges.resize(n);
  }

  bool sum(std::uint8_t a, std::uint8_t b, std::uint8_t& row) {
    const std::size_t first = plan_.weights.size() + plan_.differences.size();
    const auto found = std::find_if(plan_.sums.begin(), plan_.sums.end(),
                                    [&](const RowPair& pair) { return pair.a == a && pair.b == b; });
    const std::size_t at = first + static_cast<std::size_t>(found - plan_.sums.begin());
    if (at >= kZeros) return false;
    if (found == plan_.sums.end()) plan_.sums.push_back({a, b});
    row = static_cast<std::uint8_t>(at);
    return true;
  }

  // From edge i on; returns the first edge that is not in it.
  std::size_t add_chain(const std::vector<Edge>& edges, std::size_t i, int dy, bool rising) {
    EdgeChain chain{static_cast<std::int16_t>(edges[i].dx), static_cast<std::int16_t>(dy), {edges[i].row}};
    int length = 1;
    for (++i; i < edges.size(); ++i) {
      const int offset = edges[i].dx - chain.dx;
      if (offset < length || offset >= kMaxChain || offset > length + 1) break;
      plan_.has_zeros |= offset > length;
      while (length < offset) chain.rows[length++] = kZeros;
      chain.rows[length++] = edges[i].row;
    }
    plan_.chains[rising][length - 1].chains.push_back(chain);
    return i;
  }
};

}  // namespace

namespace {

// At most: a row a level, and one a step between two of them.
std::size_t value_rows(const Kernel& kernel) { return kernel.levels.size() + kernel.steps.size(); }

// `added` and `taken` are null or kernels.
EdgePlan plan_of_both(const Kernel* added, const Kernel* taken) {
  Planner planner(added != nullptr ? added->levels.size() - 1 : 0);
  std::vector<std::size_t> first_rows;
  std::vector<const Kernel*> kernels;
  for (const Kernel* kernel : {added, taken}) {
    if (kernel == nullptr) continue;
    kernels.push_back(kernel);
    first_rows.push_back(planner.add_levels(*kernel));
  }
  std::size_t most_rows = 0;
  for (const Kernel* kernel : kernels) most_rows += value_rows(*kernel);
  if (most_rows >= kMostValueRows) throw std::logic_error("a kernel has too many levels");
  std::vector<std::vector<std::uint8_t>> rows;
  int radius = 0;
  for (std::size_t i = 0; i < kernels.size(); ++i) {
    rows.push_back(planner.add_steps(*kernels[i], first_rows[i]));
    radius = std::max(radius, kernels[i]->radius_y);
  }
  for (int dy = -radius; dy <= radius; ++dy) {
    for (std::size_t i = 0; i < kernels.size(); ++i) planner.add_edges(*kernels[i], rows[i], dy);
    planner.end_row(dy);
  }
  return planner.plan();
}

}  // namespace

EdgePlan plan_of(const Kernel& kernel) {
  EdgePlan plan = plan_of_both(&kernel, nullptr);
  plan.pairs = pairs_of(kernel);
  return plan;
}

std::vector<EdgePlan> plans_of_move(const Kernel& from, const Kernel& to) {
  std::vector<EdgePlan> plans;
  if (value_rows(from) + value_rows(to) < kMostValueRows) {
    plans.push_back(plan_of_both(&to, &from));
  } else {
    plans.push_back(plan_of_both(&to, nullptr));
    plans.push_back(plan_of_both(nullptr, &from));
  }
  return plans;
}

}  // namespace pullfocus
