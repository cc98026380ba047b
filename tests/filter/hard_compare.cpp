#include <algorithm>
#include <bit>
#include <cmath>

#include "hard_shots.h"
#include "hard_twins.h"
#include "plain_frames.h"

namespace pullfocus::test {

namespace {

std::vector<std::uint32_t> bits_of(const std::vector<float>& values) {
  std::vector<std::uint32_t> bits;
  for (const float value : values) bits.push_back(std::bit_cast<std::uint32_t>(value));
  return bits;
}

std::vector<float> samples_of(const ColourImage& image) {
  std::vector<float> samples;
  for_each_in(image.window(), [&](int x, int y) {
    for (int c = 0; c < 4; ++c) samples.push_back(image.get(x, y, c));
  });
  return samples;
}

void judge(const std::vector<float>& picture, const TruePicture& truth, Outcome& outcome, double* share_of_bound) {
  std::int64_t not_finite = 0;
  for (std::size_t i = 0; i < picture.size(); ++i) {
    if (!std::isfinite(picture[i])) {
      ++not_finite;
      continue;
    }
    const long double off = std::fabs(static_cast<long double>(picture[i]) - truth.rgba[i]);
    outcome.error = std::max(outcome.error, static_cast<double>(off / std::max(std::fabs(truth.rgba[i]), 1e-6L)));
    if (share_of_bound != nullptr)
      *share_of_bound = std::max(*share_of_bound, static_cast<double>(off / truth.bound[i]));
  }
  outcome.not_finite = std::max(outcome.not_finite, not_finite);
}

// Everything that must come back.
struct Memory {
  std::vector<std::uint32_t> float_sums, float_picture, filter_picture;
  std::vector<Accumulator> filter_sums;
};

}  // namespace

Comparison compare(const HardShot& shot, int threads) {
  FilterOptions options = options_up_to(shot.max_coc_px);
  options.threads = threads;
  options.slice_edges = 5000;
  const auto kernels = std::make_shared<const KernelTable>(options.kernel);
  IncrementalFilter filter(shot.window, options, kernels);
  FloatTwin twin(shot.window, kernels);
  Footprints footprints(shot.window, kernels);
  Comparison result;
  Frame frame;
  CocFunction coc;
  const auto run = [&](int f, bool look) {
    shot.at(f, frame, coc);
    filter.filter(frame, coc, [] { return false; });  // a call that could be stopped takes changes over, never rebuilds
    twin.filter(frame, coc);
    if (!look) return;
    const TruePicture truth = true_picture(frame, coc, footprints);
    judge(twin.picture(), truth, result.float32, nullptr);
    judge(samples_of(filter.result()), truth, result.filter, &result.share_of_bound);
    result.exact &= holds(filter, wide_sums(filter.committed(), footprints));
  };
  const auto remember = [&] {
    return Memory{bits_of(twin.sums()), bits_of(twin.picture()), bits_of(samples_of(filter.result())),
                  sums_with_alpha(filter)};
  };

  run(0, true);
  const Memory before = remember();
  for (int f = 1; f < shot.frames; ++f) run(f, f % std::max(1, shot.frames / 8) == 0);
  run(0, true);
  const Memory after = remember();
  result.float32.same_bits = before.float_sums == after.float_sums && before.float_picture == after.float_picture;
  result.filter.same_bits = before.filter_sums == after.filter_sums && before.filter_picture == after.filter_picture;
  return result;
}

}  // namespace pullfocus::test
