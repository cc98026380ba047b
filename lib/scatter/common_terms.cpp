#include "scatter/common_terms.h"

#include <algorithm>
#include <numeric>
#include <span>
#include <utility>

namespace pullfocus {

namespace {

// A sum costs about as much as reading its row three to four times.
constexpr std::size_t kFewestUses = 4;

// Row a, row b `shift` columns behind it, and the number of a chain that has both: packed, so that finding what is
// common is sorting numbers.
using Pair = std::uint64_t;
constexpr int kChainBits = 24;
Pair pack(const BlockPlan::RowSum& sum, std::size_t chain) {
  return ((Pair{sum.a} << 12 | sum.b) << 4 | sum.shift) << kChainBits | chain;
}
BlockPlan::RowSum sum_in(Pair pair) {
  const Pair sum = pair >> kChainBits;
  return {static_cast<std::uint16_t>(sum >> 16), static_cast<std::uint16_t>(sum >> 4 & 0xfff),
          static_cast<std::uint8_t>(sum & 0xf)};
}
std::size_t chain_in(Pair pair) { return pair & ((Pair{1} << kChainBits) - 1); }

// Of two terms of one sign.
BlockPlan::RowSum sum_of(const PlannedTerm& s, const PlannedTerm& t) {
  const bool s_first = s.shift < t.shift || (s.shift == t.shift && s.row <= t.row);
  const PlannedTerm &first = s_first ? s : t, &second = s_first ? t : s;
  return {first.row, second.row, static_cast<std::uint8_t>(second.shift - first.shift)};
}

class Sharing {
 public:
  explicit Sharing(std::vector<PlannedChain>& chains) : chains_(chains) {}

  std::vector<BlockPlan::RowSum> share() {
    // Pairs of older rows have become no more frequent in the last round.
    for (std::size_t new_rows = 0;;) {
      count_pairs(new_rows);
      new_rows = BlockPlan::kMostRows + sums_.size();
      make_rows();
      if (new_rows == BlockPlan::kMostRows + sums_.size()) break;
    }
    sort_by_width();
    return std::move(sums_);
  }

 private:
  struct Use {
    PlannedChain* chain;
    std::size_t first, second;  // terms
  };

  std::vector<PlannedChain>& chains_;
  std::vector<BlockPlan::RowSum> sums_;
  std::vector<Pair> pairs_;
  std::vector<Use> uses_;

  // Those with a row from `first_row` on.
  void count_pairs(std::size_t first_row) {
    pairs_.clear();
    for (std::size_t chain = 0; chain < chains_.size(); ++chain) {
      const std::vector<PlannedTerm>& terms = chains_[chain].terms;
      for (std::size_t i = 0; i < terms.size(); ++i) {
        for (std::size_t k = i + 1; k < terms.size(); ++k) {
          if (terms[i].taken != terms[k].taken || std::max(terms[i].row, terms[k].row) < first_row) continue;
          pairs_.push_back(pack(sum_of(terms[i], terms[k]), chain));
        }
      }
    }
    std::sort(pairs_.begin(), pairs_.end());
  }

  // Of pairs that are common, the most frequent first.
  void make_rows() {
    struct Common {
      std::size_t begin, end;  // pairs
    };
    std::vector<Common> all;
    for (std::size_t at = 0; at < pairs_.size();) {
      std::size_t end = at + 1;
      while (end < pairs_.size() && pairs_[end] >> kChainBits == pairs_[at] >> kChainBits) ++end;
      if (end - at >= kFewestUses) all.push_back({at, end});
      at = end;
    }
    std::stable_sort(all.begin(), all.end(),
                     [](const Common& a, const Common& b) { return a.end - a.begin > b.end - b.begin; });
    for (const Common& common : all) make_row({pairs_.data() + common.begin, common.end - common.begin});
  }

  // If the pair is still in enough chains.
  void make_row(std::span<const Pair> pairs) {
    if (sums_.size() == BlockPlan::kMostWide) return;
    const BlockPlan::RowSum sum = sum_in(pairs.front());
    uses_.clear();
    for (const Pair pair : pairs) add_use(chains_[chain_in(pair)], sum);
    if (uses_.size() < kFewestUses) return;
    const auto row = static_cast<std::uint16_t>(BlockPlan::kMostRows + sums_.size());
    for (const Use& use : uses_) {
      std::vector<PlannedTerm>& terms = use.chain->terms;
      PlannedTerm& kept = terms[use.first];
      kept.shift = std::min(kept.shift, terms[use.second].shift);
      kept.row = row;
      terms.erase(terms.begin() + static_cast<std::ptrdiff_t>(use.second));
    }
    sums_.push_back(sum);
  }

  // One for each chain, in which the pair may be several times.
  void add_use(PlannedChain& chain, const BlockPlan::RowSum& sum) {
    if (!uses_.empty() && uses_.back().chain == &chain) return;
    for (std::size_t i = 0; i < chain.terms.size(); ++i) {
      for (std::size_t k = i + 1; k < chain.terms.size(); ++k) {
        if (chain.terms[i].taken == chain.terms[k].taken && sum_of(chain.terms[i], chain.terms[k]) == sum) {
          return uses_.push_back({&chain, i, k});
        }
      }
    }
  }

  // A row is read from before its first column on, where the one before it may still go on unless it is no wider:
  // width + shift <= BlockPlan::kMostSpread in all uses. Parts stay in front of their sums.
  void sort_by_width() {
    std::vector<int> width(sums_.size());
    const auto width_of = [&](std::uint16_t row) {
      return row < BlockPlan::kMostRows ? 0 : width[row - BlockPlan::kMostRows];
    };
    for (std::size_t i = 0; i < sums_.size(); ++i) {
      width[i] = std::max(width_of(sums_[i].a), sums_[i].shift + width_of(sums_[i].b));
    }
    std::vector<std::size_t> order(sums_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t i, std::size_t k) { return width[i] < width[k]; });
    std::vector<std::uint16_t> now(sums_.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
      now[order[i]] = static_cast<std::uint16_t>(BlockPlan::kMostRows + i);
    }
    const auto renumber = [&](std::uint16_t& row) {
      if (row >= BlockPlan::kMostRows) row = now[row - BlockPlan::kMostRows];
    };
    std::vector<BlockPlan::RowSum> sorted;
    for (const std::size_t i : order) sorted.push_back(sums_[i]);
    for (BlockPlan::RowSum& sum : sorted) {
      renumber(sum.a);
      renumber(sum.b);
    }
    sums_ = std::move(sorted);
    for (PlannedChain& chain : chains_) {
      for (PlannedTerm& term : chain.terms) renumber(term.row);
    }
  }
};

}  // namespace

std::vector<BlockPlan::RowSum> share_terms(std::vector<PlannedChain>& chains) { return Sharing(chains).share(); }

}  // namespace pullfocus
