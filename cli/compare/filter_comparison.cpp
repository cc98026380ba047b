#include <fmt/format.h>

#include <algorithm>

#include "command.h"
#include "compare/continuous.h"
#include "compare/pictures.h"
#include "compare/run.h"
#include "compare/thumbnails.h"
#include "image/error.h"
#include "progress.h"

namespace pullfocus::cli {

namespace {

constexpr std::size_t index_of(Against against) { return static_cast<std::size_t>(against); }

struct Runner {
  std::unique_ptr<Filter> filter;
  std::size_t row = 0;         // in the result
  std::size_t linear = 0;      // runner of the group's linear filter
  std::size_t continuous = 0;  // in Work::continuous, for linear filters
};

Row row_of(const FilterArguments& a) {
  Row row;
  row.kernel = a.kernel.kernel;
  row.visibility = a.visibility;
  row.coc_step = fmt::format("{}", a.coc_step);
  row.method = a.method;
  if (parse_method(a.method) != Method::linear) {
    row.budget = a.budget;
    const Budget budget = Budget::parse(a.budget);
    if (budget.kind != Budget::Kind::percent || budget.amount < 100) row.order = a.order;
  }
  return row;
}

std::size_t first_frames(std::size_t count, bool quick) {
  return quick ? std::min<std::size_t>(count, kQuickFrames) : count;
}

}  // namespace

struct FilterComparison::Work {
  Shot shot;
  std::optional<PictureSequence> truth;
  std::vector<exr::SequenceFrame> frames;
  bool with_pictures;
  std::vector<Runner> runners;
  std::vector<ContinuousFilter> continuous;
  ShotResult result;
  ShotFrame current;
  Frame true_frame;

  Work(const InputArguments& input, const CameraArguments& camera, const CompareArguments& a,
       const std::string& pattern)
      : shot(input, camera, exr::BadFrames::fail), with_pictures(!a.html.empty()) {
    const exr::Sequence& sequence = shot.sequence();
    frames = sequence.frames;
    frames.resize(first_frames(frames.size(), a.lists.quick));
    result.input = sequence.pattern.text();
    result.truth = pattern;
    result.window = sequence.display_window;
    result.peak = a.peak;
    result.measure_every = a.measure_every;
    result.camera = shot.camera().describe(frames.front().frame, sequence.first);
    if (pattern.empty()) return;
    truth.emplace(pattern, "", "--truth");
    truth->require_window(sequence.display_window, sequence.pattern.text());
    for (std::size_t i = 0; i < frames.size(); i += static_cast<std::size_t>(a.measure_every)) {
      if (truth_of(frames[i].frame) != nullptr) return;
    }
    if (std::ranges::any_of(frames, [&](const auto& f) { return truth_of(f.frame) != nullptr; })) {
      throw Error(ErrorCode::usage,
                  fmt::format("--truth {}: has none of the frames that are measured: give another --measure-every",
                              truth->sequence().pattern.text()));
    }
    throw Error(ErrorCode::usage,
                fmt::format("--truth {}: has none of the frames that are compared", truth->sequence().pattern.text()));
  }

  const exr::SequenceFrame* truth_of(int frame) const {
    return truth ? truth->find(frame, frames.size() == 1) : nullptr;
  }

  void add_group(const Group& group, const ShotFacts& facts, bool quantisation) {
    std::shared_ptr<const KernelTable> kernels;
    const std::size_t linear = runners.size();
    for (const FilterArguments& arguments : group) {
      const FilterOptions options = filter_options(arguments, facts);
      if (!kernels) kernels = std::make_shared<const KernelTable>(options.kernel);
      Runner runner{make_filter(parse_method(arguments.method), shot.state_window(), options, kernels), runners.size(),
                    linear, 0};
      if (runners.size() == linear && quantisation) runner.continuous = add_continuous(arguments, options);
      runners.push_back(std::move(runner));
      result.rows.push_back(row_of(arguments));
      result.rows.back().linear = linear;
    }
  }

  // One for each kernel and visibility.
  std::size_t add_continuous(const FilterArguments& a, const FilterOptions& options) {
    for (std::size_t i = 0; i < continuous.size(); ++i) {
      if (continuous[i].is(a.kernel.kernel, a.visibility)) return i;
    }
    continuous.emplace_back(a.kernel.kernel, a.visibility, shot.state_window(), options);
    return continuous.size() - 1;
  }

  // Of all frames with a truth, or else of all frames: the middle one.
  void choose_picture_frame() {
    if (!with_pictures) return;
    std::vector<int> candidates;
    for (const auto& frame : frames) {
      if (!truth || truth_of(frame.frame) != nullptr) candidates.push_back(frame.frame);
    }
    result.picture_frame = candidates[candidates.size() / 2];
  }

  void do_frame(std::size_t number) {
    const exr::SequenceFrame& from = frames[number];
    shot.read(from, current, false);
    const CocFunction coc = shot.camera().coc(from.frame, current.file);
    std::vector<Stats> stats(runners.size());
    for (std::size_t i = 0; i < runners.size(); ++i) {
      const std::size_t turn = (i + number) % runners.size();
      stats[turn] = runners[turn].filter->filter(current.frame, coc);
    }
    const bool measured = number % static_cast<std::size_t>(result.measure_every) == 0;
    const bool pictured = result.picture_frame == from.frame;
    if (measured || pictured) {
      for (ContinuousFilter& c : continuous) c.filter(current.frame, coc);
    }

    const exr::SequenceFrame* true_picture = measured || pictured ? truth_of(from.frame) : nullptr;
    if (true_picture != nullptr) truth->read(*true_picture, result.window, true_frame);
    for (std::size_t i = 0; i < runners.size(); ++i) {
      FrameResult& to = result.rows[i].frames.emplace_back();
      to.frame = from.frame;
      to.stats = stats[i];
      if (measured) measure(runners[i], true_picture != nullptr, to.errors);
    }
    if (pictured) take_pictures(true_picture != nullptr);
  }

  void measure(const Runner& runner, bool with_truth, ErrorsAgainst& errors) {
    const Window& all = shot.state_window();
    const ColourImage& picture = runner.filter->result();
    const bool is_linear = runner.row == runner.linear;
    errors[index_of(Against::linear)] =
        is_linear ? PictureErrors{}
                  : picture_errors(picture, runners[runner.linear].filter->result(), all, result.peak);
    if (is_linear && !continuous.empty()) {
      errors[index_of(Against::quantisation)] =
          picture_errors(picture, continuous[runner.continuous].result(), all, result.peak);
    }
    if (!with_truth) return;
    const ErrorsAgainst& linear = result.rows[runners[runner.linear].row].frames.back().errors;
    if (!is_linear && picture == runners[runner.linear].filter->result()) {
      errors[index_of(Against::truth)] = linear[index_of(Against::truth)];
    } else {
      errors[index_of(Against::truth)] = picture_errors(picture, true_frame.colour, result.window, result.peak);
    }
  }

  void take_pictures(bool with_truth) {
    const Window& w = result.window;
    result.pictures.push_back(thumbnail("input", current.frame.colour, w));
    if (with_truth) result.pictures.push_back(thumbnail("truth", true_frame.colour, w));
    for (const Runner& runner : runners) {
      Row& row = result.rows[runner.row];
      const ColourImage& picture = runner.filter->result();
      row.pictures.push_back(thumbnail("result", picture, w));
      if (runner.row != runner.linear) {
        row.pictures.push_back(
            error_thumbnail("FLIP against linear", picture, runners[runner.linear].filter->result(), w));
      } else if (!continuous.empty()) {
        row.pictures.push_back(
            error_thumbnail("FLIP of quantisation", picture, continuous[runner.continuous].result(), w));
      }
      if (with_truth) row.pictures.push_back(error_thumbnail("FLIP against truth", picture, true_frame.colour, w));
    }
  }
};

FilterComparison::FilterComparison(const InputArguments& input, const CameraArguments& camera,
                                   const std::vector<Group>& groups, const CompareArguments& arguments,
                                   const std::string& truth)
    : work_(std::make_unique<Work>(input, camera, arguments, truth)) {
  const ShotFacts facts = work_->shot.facts();
  const bool quantisation = !arguments.no_quantisation && !arguments.lists.quick;
  for (const Group& group : groups) work_->add_group(group, facts, quantisation);
  work_->result.threads = groups.front().front().threads;
  set_labels(work_->result);
  work_->choose_picture_frame();
}

FilterComparison::~FilterComparison() = default;

ShotResult FilterComparison::run() {
  Progress progress(work_->frames.size());
  for (std::size_t i = 0; i < work_->frames.size(); ++i) {
    if (interrupted()) throw Error(ErrorCode::content, "interrupted: nothing was written");
    work_->do_frame(i);
    progress.done(work_->frames[i].frame);
  }
  return std::move(work_->result);
}

}  // namespace pullfocus::cli
