#include "scatter/block_plan.h"

#include <algorithm>
#include <cstdlib>
#include <numeric>
#include <tuple>
#include <utility>

#include "scatter/common_terms.h"

namespace pullfocus {

namespace {

// Source rows [from, to) of one edge of the kernel that fall on the same column.
struct Stretch {
  int dx;
  bool rising;
  int row, from, to;
};

class BlockPlanner {
 public:
  explicit BlockPlanner(const EdgePlan& edges) : edges_(edges) {
    plan_.radius_y = edges.radius_y;
    plan_.rows_a_line = edges.value_rows();
    sum_at_.assign(plan_.rows_a_line * kBlockRows * (kBlockRows + 1), 0);
  }

  BlockPlan plan(CommonSums sums) {
    if (kBlockRows * plan_.rows_a_line > BlockPlan::kMostRows) return {};
    for (int dy = -plan_.radius_y; dy < plan_.radius_y + kBlockRows; ++dy) {
      collect(dy);
      for (std::size_t i = 0; i < stretches_.size();) i = add_chain(i, dy);
      if (plan_.value_rows() > BlockPlan::kMostRows) return {};
    }
    if (sums == CommonSums::found) plan_.wide = share_terms(chains_);
    const auto others = std::stable_partition(chains_.begin(), chains_.end(),
                                              [](const PlannedChain& chain) { return chain.terms.size() == 1; });
    std::stable_sort(chains_.begin(), others, [](const PlannedChain& a, const PlannedChain& b) {
      return key_of(a.terms.front()) < key_of(b.terms.front());
    });
    for (auto chain = chains_.begin(); chain != chains_.end(); ++chain) list(*chain, chain < others);
    plan_.cost = cost();
    if (plan_.cost >= BlockPlan::kAllRows) return {};
    return std::move(plan_);
  }

 private:
  const EdgePlan& edges_;
  BlockPlan plan_;
  std::vector<PlannedChain> chains_;
  std::vector<Stretch> stretches_;     // of one row of the picture
  std::vector<std::uint16_t> sum_at_;  // value row of a stretch of several source rows, 0 if there is none yet

  // Fitted to measured times, a tenth on the safe side. Its unit is a vector of two columns that is read and written.
  // Adding a value to one costs 0.3, and up to 0.7 where there are too many value rows for the innermost cache; making
  // a value row costs 3.
  int cost() const {
    const auto count = static_cast<double>(plan_.value_rows() + plan_.wide.size());
    const double term = std::clamp(0.3 + 0.005 * (count - 40), 0.3, 0.7);
    double block = 3 * count, rows = 0;
    for (int spread = 0; spread < BlockPlan::kSpreads; ++spread) {
      const double vectors = (kBlockColumns + spread * BlockPlan::kSpreadStep) / 2.;
      const BlockPlan::Chains& list = plan_.of_spread[spread];
      const auto reads = static_cast<double>(list.groups.size() + list.terms.size() - in_groups(list));
      block += vectors * (static_cast<double>(list.chains.size()) + term * reads);
    }
    for (const auto& lists : edges_.chains) {
      for (int length = 1; length <= kMaxChain; ++length) {
        const double vectors = (8 + length) / 2.;
        rows += vectors * (1 + 0.3 * length) * static_cast<double>(lists[length - 1].chains.size());
      }
    }
    rows *= kBlockRows * kBlockColumns / 8.;
    return static_cast<int>(BlockPlan::kAllRows * 1.1 * block / rows);
  }

  static std::size_t in_groups(const BlockPlan::Chains& list) {
    return std::accumulate(list.groups.begin(), list.groups.end(), std::size_t{0});
  }

  // The edges of all source rows in row dy: those of neighbouring source rows at one column become one stretch.
  void collect(int dy) {
    stretches_.clear();
    for (int line = 0; line < kBlockRows; ++line) {
      const int of_kernel = dy - line;
      if (std::abs(of_kernel) > edges_.radius_y) continue;
      for (const bool rising : {false, true}) {
        for (int length = 1; length <= kMaxChain; ++length) {
          for (const EdgeChain& chain : edges_.rows(rising, length, of_kernel, of_kernel + 1)) {
            for (int k = 0; k < length; ++k) add_edge({chain.dx + k, rising, chain.rows[k], line, line + 1});
          }
        }
      }
    }
    std::sort(stretches_.begin(), stretches_.end(), [](const Stretch& a, const Stretch& b) {
      return std::tie(a.dx, a.rising, a.row, a.from) < std::tie(b.dx, b.rising, b.row, b.from);
    });
    std::size_t n = 0;
    for (const Stretch& next : stretches_) {
      Stretch* last = n > 0 ? &stretches_[n - 1] : nullptr;
      if (last != nullptr && last->dx == next.dx && last->rising == next.rising && last->row == next.row &&
          last->to == next.from) {
        last->to = next.to;
      } else {
        stretches_[n++] = next;
      }
    }
    stretches_.resize(n);
  }

  void add_edge(const Stretch& edge) {
    const bool is_zero = edges_.has_zeros && edge.row + 1 == static_cast<int>(plan_.rows_a_line);
    if (!is_zero) stretches_.push_back(edge);
  }

  std::uint16_t value_row(const Stretch& s) {
    const auto base = [&](int line) {
      return static_cast<std::uint16_t>(static_cast<std::size_t>(line) * plan_.rows_a_line +
                                        static_cast<std::size_t>(s.row));
    };
    if (s.to == s.from + 1) return base(s.from);
    std::uint16_t& at =
        sum_at_[(static_cast<std::size_t>(s.row) * kBlockRows + static_cast<std::size_t>(s.from)) * (kBlockRows + 1) +
                static_cast<std::size_t>(s.to)];
    if (at == 0) {
      Stretch shorter = s;
      --shorter.to;
      const BlockPlan::RowSum sum{value_row(shorter), base(s.to - 1), 0};
      at = static_cast<std::uint16_t>(plan_.value_rows());
      plan_.sums.push_back(sum);
    }
    return at;
  }

  // From stretch i on; returns the first that is not in it.
  std::size_t add_chain(std::size_t i, int dy) {
    const int dx = stretches_[i].dx;
    std::size_t end = i;
    while (end < stretches_.size() && stretches_[end].dx <= dx + BlockPlan::kMostSpread) ++end;
    PlannedChain chain{static_cast<std::int16_t>(dx), static_cast<std::int16_t>(dy), stretches_[end - 1].dx - dx, {}};
    for (std::size_t k = i; k < end; ++k) {
      const Stretch& stretch = stretches_[k];
      chain.terms.push_back({value_row(stretch), static_cast<std::uint8_t>(stretch.dx - dx), !stretch.rising});
    }
    chains_.push_back(std::move(chain));
    return end;
  }

  static int key_of(const PlannedTerm& term) { return (term.row * 16 + term.shift) * 2 + term.taken; }

  void list(const PlannedChain& chain, bool in_group) {
    BlockPlan::Chains& list = plan_.of_spread[(chain.spread + BlockPlan::kSpreadStep - 1) / BlockPlan::kSpreadStep];
    BlockChain listed{chain.dx, chain.dy, 0, 0};
    for (const bool taken : {false, true}) {
      for (const PlannedTerm& planned : chain.terms) {
        if (planned.taken != taken) continue;
        BlockTerm term{};
        term.row = planned.row & 0xfff;
        term.shift = planned.shift & 0xf;
        list.terms.push_back(term);
        ++(taken ? listed.taken : listed.added);
      }
    }
    list.chains.push_back(listed);
    if (!in_group) return;
    const std::size_t last = list.chains.size() - 1;  // of the terms, too
    const bool is_like_last =
        last > 0 && list.terms[last] == list.terms[last - 1] && list.chains[last].taken == list.chains[last - 1].taken;
    if (!is_like_last) list.groups.push_back(0);
    ++list.groups.back();
  }
};

}  // namespace

BlockPlan block_plan_of(const EdgePlan& plan, CommonSums sums) { return BlockPlanner(plan).plan(sums); }

}  // namespace pullfocus
