// [orders]: error against linear under partial budgets, for every order. Counts and errors only, no times: repeatable
// to the last digit.
#include <fmt/format.h>

#include <fstream>

#include "bench/measured_shots.h"
#include "bench/picture_error.h"
#include "bench/table.h"
#include "filter/filter.h"
#include "image/error.h"

namespace pullfocus::cli::bench {

namespace {

constexpr Order kOrders[] = {Order::gain, Order::fearing, Order::random};
constexpr double kBudgets[] = {5, 15, 30, 60, 100};

class Measurement {
 public:
  explicit Measurement(MeasuredShot shot) : shot_(std::move(shot)) {
    options_.output_type = SampleType::float32;
    options_.visibility.kind = VisibilityOptions::Kind::none;
    kernels_ = std::make_shared<const KernelTable>(options_.kernel);
    const auto linear = make_linear_filter(shot_.frames[0].window(), options_, kernels_);
    for (std::size_t i = 0; i < shot_.frames.size(); ++i) {
      linear->filter(shot_.frames[i], shot_.coc[i]);
      exact_.push_back(linear->result());
    }
  }

  const MeasuredShot& shot() const { return shot_; }

  // Of every frame but the first.
  std::vector<PictureError> errors(Order order, double percent) const {
    FilterOptions options = options_;
    options.budget.amount = percent;
    options.importance.order = order;
    const auto filter = make_incremental_filter(shot_.frames[0].window(), options, kernels_);
    std::vector<PictureError> errors;
    for (std::size_t i = 0; i < shot_.frames.size(); ++i) {
      filter->filter(shot_.frames[i], shot_.coc[i]);
      if (i > 0) errors.emplace_back().add(filter->result(), exact_[i]);
    }
    return errors;
  }

 private:
  MeasuredShot shot_;
  FilterOptions options_;
  std::shared_ptr<const KernelTable> kernels_;
  std::vector<ColourImage> exact_;
};

double mean_psnr(const std::vector<PictureError>& errors) {
  double sum = 0;
  for (const PictureError& e : errors) sum += psnr(e.rmse());
  return sum / static_cast<double>(errors.size());
}

double mean_rmse(const std::vector<PictureError>& errors) {
  double sum = 0;
  for (const PictureError& e : errors) sum += e.rmse();
  return sum / static_cast<double>(errors.size());
}

// Blocks of "budget gain fearing random" after a line with the shot's name, as docs/orders.gp plots them.
class PlotData {
 public:
  explicit PlotData(const std::string& path) : path_(path) {
    if (path_.empty()) return;
    file_.open(path_);
    check();
  }
  void add(const std::string& shot, const std::vector<std::vector<double>>& by_order) {
    if (path_.empty()) return;
    file_ << "\n\n\"" << shot << "\"\n";
    for (std::size_t b = 0; b < std::size(kBudgets); ++b) {
      file_ << kBudgets[b];
      for (const auto& row : by_order) file_ << ' ' << row[b];
      file_ << '\n';
    }
    file_.flush();
    check();
  }

 private:
  void check() const {
    if (!file_) throw Error(ErrorCode::unwritable, path_ + ": cannot be written: give --data another file");
  }
  const std::string path_;
  std::ofstream file_;
};

void tabulate(const Measurement& m, Report& report, PlotData& data) {
  report.paragraph(fmt::format("**{}**: {}", m.shot().name, m.shot().description));
  std::vector<std::string> columns{"order"};
  for (const double budget : kBudgets) columns.push_back(fmt::format("{:g} %", budget));
  report.columns(columns);
  std::vector<std::vector<double>> by_order;
  for (const Order order : kOrders) {
    std::vector<double>& row = by_order.emplace_back();
    std::vector<std::string> cells{std::string(name(order))};
    for (const double budget : kBudgets) {
      row.push_back(mean_rmse(m.errors(order, budget)));
      cells.push_back(fmt::format("{:.6f}", row.back()));
    }
    report.row(cells);
  }
  std::vector<std::string> cells{fmt::format("{} against the best", name(kOrders[0]))};
  for (std::size_t b = 0; b < std::size(kBudgets); ++b) {
    double best = by_order[0][b];
    for (const auto& row : by_order) best = std::min(best, row[b]);
    cells.push_back(fmt::format("{:+.1f} %", best > 0 ? 100 * (by_order[0][b] / best - 1) : 0.));
  }
  report.row(cells);
  report.end();
  data.add(m.shot().name, by_order);
}

void tabulate_last_frames(const Measurement& m, Report& report) {
  report.paragraph(fmt::format("**{}** at 15 %, peak 1:", m.shot().name));
  report.columns({"order", "mean PSNR", "worst PSNR", "PSNR of the last frame", "largest error of the last frame"});
  for (const Order order : kOrders) {
    const std::vector<PictureError> errors = m.errors(order, 15);
    double worst = 0;
    for (const PictureError& e : errors) worst = std::max(worst, e.rmse());
    report.row({std::string(name(order)), fmt::format("{:.1f} dB", mean_psnr(errors)),
                fmt::format("{:.1f} dB", psnr(worst)), fmt::format("{:.1f} dB", psnr(errors.back().rmse())),
                fmt::format("{:.4f}", errors.back().largest())});
  }
  report.end();
}

void print(const Settings& settings, Report& report) {
  const int frames = settings.quick ? 3 : 100;
  PlotData data(settings.data);
  for (const auto& shot : {star_shot, slow_pull, fast_pull, light_change, reversed_pull})
    tabulate(Measurement(shot(frames)), report, data);
  tabulate_last_frames(Measurement(reversed_pull(frames)), report);
}

}  // namespace

const Table kOrdersTable{
    "orders",
    "What comes first under a partial budget",
    "RMSE of the incremental filter's result against the linear filter's under partial budgets: 256x256, 100 frames "
    "of the `star-lateral` scene, kernels up to 64 px, linear RGB, mean over frames 2 to 100, no visibility; counts "
    "and errors only, repeatable to the last digit.",
    "one a processor, without effect",
    print,
    true};

}  // namespace pullfocus::cli::bench
