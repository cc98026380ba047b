// docs/transparent-edges.png: a ball with motion-blurred alpha, filtered and composited over black, white and red
// afterwards; and the rims there by visibility, in figures (a Markdown table).
//
//   transparent_edges FRAME.exr SHEET.png      FRAME: a frame of the OpenEXR project's "beachball" sequence
//
// Rows: the input; focus on the ball; focus far in front of it; the upper edge with focus on the ball, enlarged, first
// without visibility and then, as all others, with the default.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "exr/reader.h"
#include "imageio/picture.h"
#include "pullfocus.h"

namespace pullfocus {
namespace {

using Colour = std::array<float, 3>;
constexpr Colour kColours[] = {{0, 0, 0}, {1, 1, 1}, {1, 0, 0}};

CocFunction focused_at(double distance, const Window& display) {
  ThinLens lens;
  lens.focal_length_mm = 50;
  lens.f_number = 1.4;
  lens.focus_distance = distance;
  lens.metres_per_unit = 0.1;
  return coc_function(lens, {display.width(), display.height()}, DepthKind::planar);
}

float over(const ColourImage& image, int x, int y, int c, const Colour& colour) {
  return image.get(x, y, c) + (1 - image.get(x, y, 3)) * colour[static_cast<std::size_t>(c)];
}

ColourImage filtered(const Frame& frame, const CocFunction& coc, SampleType type, const char* visibility = "auto") {
  FilterOptions options;
  options.output_type = type;
  options.visibility = parse_visibility(visibility);
  const auto filter = make_incremental_filter(frame.window(), options);
  filter->filter(frame, coc);
  return filter->result();
}

// The frame over a plain colour, opaque.
Frame composite(const Frame& frame, const Colour& colour) {
  Frame result = frame;
  result.colour.reset(frame.window(), SampleType::float32);
  const Window& w = frame.window();
  for (int y = w.y0; y < w.y1; ++y) {
    for (int x = w.x0; x < w.x1; ++x) {
      for (int c = 0; c < 3; ++c) result.colour.set(x, y, c, over(frame.colour, x, y, c, colour));
      result.colour.set(x, y, 3, 1);
    }
  }
  return result;
}

// Largest difference of the composite of the filtered picture to the filtered composite, over all colours.
float rim(const Frame& frame, const CocFunction& coc, const ColourImage& result, const char* visibility) {
  float largest = 0;
  const Window& w = frame.window();
  for (const Colour& colour : kColours) {
    const ColourImage expected = filtered(composite(frame, colour), coc, SampleType::float32, visibility);
    for (int y = w.y0; y < w.y1; ++y) {
      for (int x = w.x0; x < w.x1; ++x) {
        for (int c = 0; c < 3; ++c) {
          largest = std::max(largest, std::fabs(over(result, x, y, c, colour) - expected.get(x, y, c)));
        }
      }
    }
  }
  return largest;
}

// What shines through the ball: 1 - alpha at the pixels around which all is opaque as far as its own blur reaches.
struct Loss {
  float largest = 0;
  double share = 0;       // of those pixels, where it is more than 1 %
  float least_alpha = 1;  // of all opaque pixels, those that its blurred edge reaches included
};

Loss loss_inside(const Frame& frame, const ColourImage& result, int reach) {
  Loss loss;
  const Window& w = frame.window();
  const auto width = static_cast<std::size_t>(w.width()) + 1;
  std::vector<int> opaque(width * (static_cast<std::size_t>(w.height()) + 1));  // sums of all to the left and above
  const auto at = [&](int x, int y) -> int& {
    return opaque[static_cast<std::size_t>(y - w.y0) * width + static_cast<std::size_t>(x - w.x0)];
  };
  for (int y = w.y0; y < w.y1; ++y) {
    for (int x = w.x0; x < w.x1; ++x) {
      const bool is_opaque = frame.colour.get(x, y, 3) == 1;
      at(x + 1, y + 1) = at(x, y + 1) + at(x + 1, y) - at(x, y) + is_opaque;
      if (is_opaque) loss.least_alpha = std::min(loss.least_alpha, result.get(x, y, 3));
    }
  }
  int inside = 0, lossy = 0;
  const int side = 2 * reach + 1;
  for (int y = w.y0; y + side <= w.y1; ++y) {
    for (int x = w.x0; x + side <= w.x1; ++x) {
      if (at(x + side, y + side) - at(x, y + side) - at(x + side, y) + at(x, y) != side * side) continue;
      const float lost = 1 - result.get(x + reach, y + reach, 3);
      loss.largest = std::max(loss.largest, lost);
      ++inside;
      lossy += lost > 0.01f;
    }
  }
  loss.share = inside > 0 ? static_cast<double>(lossy) / inside : 0;
  return loss;
}

class Sheet {
 public:
  Sheet(int columns, int rows) : picture_{columns * (kWidth + kGap) - kGap, rows * (kHeight + kGap) - kGap, {}} {
    picture_.rgba.assign(static_cast<std::size_t>(picture_.width) * static_cast<std::size_t>(picture_.height) * 4,
                         0.5f);
    for (std::size_t i = 3; i < picture_.rgba.size(); i += 4) picture_.rgba[i] = 1;
  }

  // `part` of the image over a colour, shrunk or enlarged to the cell by nearest or box sampling.
  void put(int column, int row, const ColourImage& image, const Window& part, const Colour& colour) {
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        const Window source{part.x0 + x * part.width() / kWidth, part.y0 + y * part.height() / kHeight,
                            part.x0 + (x + 1) * part.width() / kWidth, part.y0 + (y + 1) * part.height() / kHeight};
        const int x1 = std::max(source.x1, source.x0 + 1), y1 = std::max(source.y1, source.y0 + 1);
        for (int c = 0; c < 3; ++c) {
          float sum = 0;
          for (int sy = source.y0; sy < y1; ++sy) {
            for (int sx = source.x0; sx < x1; ++sx) sum += over(image, sx, sy, c, colour);
          }
          const std::size_t at =
              (static_cast<std::size_t>(row * (kHeight + kGap) + y) * static_cast<std::size_t>(picture_.width) +
               static_cast<std::size_t>(column * (kWidth + kGap) + x)) *
                  4 +
              static_cast<std::size_t>(c);
          picture_.rgba[at] = sum / static_cast<float>((x1 - source.x0) * (y1 - source.y0));
        }
      }
    }
  }

  const imageio::Picture& picture() const { return picture_; }

 private:
  static constexpr int kWidth = 360, kHeight = 300, kGap = 8;
  imageio::Picture picture_;
};

struct Ball {
  Window bounds;
  float nearest = std::numeric_limits<float>::infinity(), farthest = 0;
};

Ball find_ball(const Frame& frame) {
  Ball ball;
  const Window& w = frame.window();
  for (int y = w.y0; y < w.y1; ++y) {
    for (int x = w.x0; x < w.x1; ++x) {
      if (frame.colour.get(x, y, 3) == 0) continue;
      ball.bounds = unite(ball.bounds, {x, y, x + 1, y + 1});
      ball.nearest = std::min(ball.nearest, frame.depth.at(x, y));
      ball.farthest = std::max(ball.farthest, frame.depth.at(x, y));
    }
  }
  return ball;
}

void print_rims(const Frame& frame, const Ball& ball) {
  fmt::print(
      "| focus | CoC of the ball | visibility | difference | largest loss | more than 1 % lost | least alpha |\n"
      "|---|---|---|---|---|---|---|\n");
  const std::pair<const char*, double> focuses[] = {{"its rim", ball.farthest},
                                                    {"its middle", (ball.farthest + ball.nearest) / 2},
                                                    {"its front", ball.nearest},
                                                    {"halfway to it", ball.farthest / 2}};
  for (const auto& [name, distance] : focuses) {
    const CocFunction coc = focused_at(distance, frame.window());
    const float front = coc(ball.nearest), back = coc(ball.farthest);
    const int reach = static_cast<int>(std::ceil(std::max(std::fabs(front), std::fabs(back)) / 2)) + 1;
    for (const char* visibility : {"none", "layers", "layers:-2,2,50", "bitmap:32"}) {
      const ColourImage result = filtered(frame, coc, SampleType::float32, visibility);
      const Loss loss = loss_inside(frame, result, reach);
      fmt::print("| {} | {:.0f} to {:.0f} px | {} | {:.1g} | {:.3f} | {:.2f} % | {:.3f} |\n", name, front, back,
                 visibility, rim(frame, coc, result, visibility), loss.largest, 100 * loss.share, loss.least_alpha);
    }
  }
}

int run(const std::string& path, const std::string& sheet_path) {
  const Window display = exr::read_header(path).display_window;
  Frame frame;
  exr::read_frame(path, {}, display, frame, nullptr);
  const Ball ball = find_ball(frame);
  const Window part = intersect(display, grow(ball.bounds, 120, 40));
  // Where the motion runs along the edge.
  const int cx = (3 * ball.bounds.x0 + ball.bounds.x1) / 4;
  const Window edge = intersect(display, {cx - 60, ball.bounds.y0, cx + 60, ball.bounds.y0 + 100});
  const CocFunction on_ball = focused_at(static_cast<double>(ball.farthest), display);
  const CocFunction in_front = focused_at(static_cast<double>(ball.farthest) / 2, display);

  Sheet sheet(3, 5);
  const ColourImage sharp = filtered(frame, on_ball, SampleType::half);
  const ColourImage plain = filtered(frame, on_ball, SampleType::half, "none");
  const ColourImage blurred = filtered(frame, in_front, SampleType::half);
  for (int k = 0; k < 3; ++k) {
    sheet.put(k, 0, frame.colour, part, kColours[k]);
    sheet.put(k, 1, sharp, part, kColours[k]);
    sheet.put(k, 2, blurred, part, kColours[k]);
    sheet.put(k, 3, plain, edge, kColours[k]);
    sheet.put(k, 4, sharp, edge, kColours[k]);
  }
  imageio::write_picture(sheet_path, sheet.picture());
  print_rims(frame, ball);
  return EXIT_SUCCESS;
}

}  // namespace
}  // namespace pullfocus

int main(int argc, char** argv) try {
  if (argc != 3) {
    fmt::print(stderr, "usage: transparent_edges FRAME.exr SHEET.png\n");
    return 2;
  }
  return pullfocus::run(argv[1], argv[2]);
} catch (const pullfocus::Error& error) {
  fmt::print(stderr, "transparent_edges: {}\n", error.what());
  return EXIT_FAILURE;
}
