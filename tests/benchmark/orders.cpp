// Error against linear under partial budgets, for every order: prints Markdown tables, and with --data FILE writes them
// for orders.gp to plot. Counts and errors only, no times: repeatable to the last digit.
//
//   orders [--quick] [--data FILE]
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>

#include "filter/filter.h"
#include "shots.h"

namespace {

using namespace pullfocus;

constexpr Order kOrders[] = {Order::gain, Order::fearing, Order::random};
constexpr double kBudgets[] = {5, 15, 30, 60, 100};

struct Error {
  double rmse = 0, largest = 0;
};

Error between(const ColourImage& a, const ColourImage& b) {
  Error error;
  const Window& w = a.window();
  for (int y = w.y0; y < w.y1; ++y) {
    for (int x = w.x0; x < w.x1; ++x) {
      for (int c = 0; c < 3; ++c) {
        const double d = static_cast<double>(a.get(x, y, c)) - static_cast<double>(b.get(x, y, c));
        error.rmse += d * d;
        error.largest = std::max(error.largest, std::fabs(d));
      }
    }
  }
  error.rmse = std::sqrt(error.rmse / (3 * static_cast<double>(w.pixels())));
  return error;
}

double psnr(double rmse) { return rmse > 0 ? -20 * std::log10(rmse) : INFINITY; }

class Measurement {
 public:
  explicit Measurement(test::MeasuredShot shot) : shot_(std::move(shot)) {
    options_.output_type = SampleType::float32;
    options_.visibility.kind = VisibilityOptions::Kind::none;
    kernels_ = std::make_shared<const KernelTable>(options_.kernel);
    const auto linear = make_linear_filter(shot_.frames[0].window(), options_, kernels_);
    for (std::size_t i = 0; i < shot_.frames.size(); ++i) {
      linear->filter(shot_.frames[i], shot_.coc[i]);
      exact_.push_back(linear->result());
    }
  }

  const test::MeasuredShot& shot() const { return shot_; }

  // Of every frame but the first.
  std::vector<Error> errors(Order order, double percent) const {
    FilterOptions options = options_;
    options.budget.amount = percent;
    options.importance.order = order;
    const auto filter = make_incremental_filter(shot_.frames[0].window(), options, kernels_);
    std::vector<Error> errors;
    for (std::size_t i = 0; i < shot_.frames.size(); ++i) {
      filter->filter(shot_.frames[i], shot_.coc[i]);
      if (i > 0) errors.push_back(between(filter->result(), exact_[i]));
    }
    return errors;
  }

 private:
  test::MeasuredShot shot_;
  FilterOptions options_;
  std::shared_ptr<const KernelTable> kernels_;
  std::vector<ColourImage> exact_;
};

double mean_psnr(const std::vector<Error>& errors) {
  double sum = 0;
  for (const Error& e : errors) sum += psnr(e.rmse);
  return sum / static_cast<double>(errors.size());
}

double mean_rmse(const std::vector<Error>& errors) {
  double sum = 0;
  for (const Error& e : errors) sum += e.rmse;
  return sum / static_cast<double>(errors.size());
}

void tabulate(const Measurement& m, std::ostream* data) {
  fmt::print("\n{}: {}\n\n| order | 5 % | 15 % | 30 % | 60 % | 100 % |\n|---|---|---|---|---|---|\n", m.shot().name,
             m.shot().description);
  if (data) *data << "\n\n\"" << m.shot().name << "\"\n";
  std::vector<std::vector<double>> by_order;
  for (const Order order : kOrders) {
    std::vector<double>& row = by_order.emplace_back();
    for (const double budget : kBudgets) row.push_back(mean_rmse(m.errors(order, budget)));
    fmt::print("| {} |", name(order));
    for (const double rmse : row) fmt::print(" {:.6f} |", rmse);
    fmt::print("\n");
  }
  fmt::print("| {} against the best |", name(kOrders[0]));
  for (std::size_t b = 0; b < std::size(kBudgets); ++b) {
    double best = by_order[0][b];
    for (const auto& row : by_order) best = std::min(best, row[b]);
    fmt::print(" {:+.1f} % |", best > 0 ? 100 * (by_order[0][b] / best - 1) : 0.);
    if (!data) continue;
    *data << kBudgets[b];
    for (const auto& row : by_order) *data << ' ' << row[b];
    *data << '\n';
  }
  fmt::print("\n");
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  bool quick = false;
  std::ofstream data;
  for (int i = 1; i < argc; ++i) {
    if (std::strcmp(argv[i], "--quick") == 0) quick = true;
    if (std::strcmp(argv[i], "--data") == 0 && i + 1 < argc) data.open(argv[++i]);
  }
  const int frames = quick ? 3 : 100;
  fmt::print("256x256, {} frames, RMSE against linear, linear RGB, mean over frames 2 to the last\n", frames);
  for (const auto& shot :
       {test::star_shot, test::slow_pull, test::fast_pull, test::light_change, test::reversed_pull}) {
    tabulate(Measurement(shot(frames)), data.is_open() ? &data : nullptr);
  }
  const Measurement pull(test::reversed_pull(frames));
  fmt::print(
      "\n{} at 15 %, peak 1:\n\n| order | mean PSNR | worst PSNR | PSNR of the last frame | largest error of the "
      "last frame |\n|---|---|---|---|---|\n",
      pull.shot().name);
  for (const Order order : kOrders) {
    const std::vector<Error> errors = pull.errors(order, 15);
    double worst = 0;
    for (const Error& e : errors) worst = std::max(worst, e.rmse);
    fmt::print("| {} | {:.1f} dB | {:.1f} dB | {:.1f} dB | {:.4f} |\n", name(order), mean_psnr(errors), psnr(worst),
               psnr(errors.back().rmse), errors.back().largest);
  }
  return 0;
}
