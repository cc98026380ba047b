#include "bench/shot_run.h"

#include "filter/filter.h"

namespace pullfocus::cli::bench {

ShotRun run_shot(const std::vector<Frame>& frames, const std::vector<CocFunction>& coc, const FilterOptions& options) {
  const auto kernels = std::make_shared<const KernelTable>(options.kernel);
  const auto linear = make_linear_filter(frames[0].window(), options, kernels);
  const auto incremental = make_incremental_filter(frames[0].window(), options, kernels);
  ShotRun run;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const double linear_ms = linear->filter(frames[i], coc[i]).filter_ms;
    const double incremental_ms = incremental->filter(frames[i], coc[i]).filter_ms;
    (i == 0 ? run.linear.first : run.linear.rest) += linear_ms;
    (i == 0 ? run.incremental.first : run.incremental.rest) += incremental_ms;
  }
  return run;
}

ShotSpeed speed_of(const std::vector<Frame>& frames, const std::vector<CocFunction>& coc, const FilterOptions& options,
                   int runs) {
  Times linear, incremental, with_first, without_first;
  for (int i = 0; i < runs; ++i) {
    const ShotRun run = run_shot(frames, coc, options);
    const double n = static_cast<double>(frames.size() - 1);
    linear.push_back(run.linear.rest / n);
    incremental.push_back(run.incremental.rest / n);
    without_first.push_back(run.linear.rest / run.incremental.rest);
    with_first.push_back(run.linear.all() / run.incremental.all());
  }
  return {median(linear), median(incremental), spread(without_first), spread(with_first)};
}

}  // namespace pullfocus::cli::bench
