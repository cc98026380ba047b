// docs/transparent-edges.png: a ball with motion-blurred alpha, filtered with the default options and composited over
// black, white and red afterwards; and the rims there, in figures.
//
//   transparent_edges FRAME.exr SHEET.png      FRAME: a frame of the OpenEXR project's "beachball" sequence
//
// Rows: the input; focus on the ball; focus far in front of it; the upper edge with the ball in focus, enlarged.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "exr/reader.h"
#include "imageio/picture.h"
#include "pullfocus.h"

namespace pullfocus {
namespace {

using Colour = std::array<float, 3>;
constexpr Colour kColours[] = {{0, 0, 0}, {1, 1, 1}, {1, 0, 0}};
constexpr const char* kNames[] = {"black", "white", "red"};

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

ColourImage filtered(const Frame& frame, const CocFunction& coc, SampleType type) {
  FilterOptions options;
  options.output_type = type;
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

// Largest difference of the composite of the filtered picture to the filtered composite.
float rim(const Frame& frame, const CocFunction& coc, const Colour& colour) {
  const ColourImage a = filtered(frame, coc, SampleType::float32);
  const ColourImage b = filtered(composite(frame, colour), coc, SampleType::float32);
  float largest = 0;
  const Window& w = frame.window();
  for (int y = w.y0; y < w.y1; ++y) {
    for (int x = w.x0; x < w.x1; ++x) {
      for (int c = 0; c < 3; ++c) largest = std::max(largest, std::fabs(over(a, x, y, c, colour) - b.get(x, y, c)));
    }
  }
  return largest;
}

// The least alpha where the frame's is 1: what shines through the ball where plain scatter lets the blurred nothing
// behind it leak onto it.
float least_opaque_alpha(const Frame& frame, const ColourImage& result) {
  float least = 1;
  const Window& w = frame.window();
  for (int y = w.y0; y < w.y1; ++y) {
    for (int x = w.x0; x < w.x1; ++x) {
      if (frame.colour.get(x, y, 3) == 1) least = std::min(least, result.get(x, y, 3));
    }
  }
  return least;
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

int run(const std::string& path, const std::string& sheet_path) {
  const Window display = exr::read_header(path).display_window;
  Frame frame;
  exr::read_frame(path, {}, display, frame, nullptr);
  Window ball;
  float depth = 0;
  for (int y = display.y0; y < display.y1; ++y) {
    for (int x = display.x0; x < display.x1; ++x) {
      if (frame.colour.get(x, y, 3) == 0) continue;
      ball = unite(ball, {x, y, x + 1, y + 1});
      depth = std::max(depth, frame.depth.at(x, y));
    }
  }
  const Window part = intersect(display, grow(ball, 120, 40));
  // Where the motion runs along the edge.
  const int cx = (3 * ball.x0 + ball.x1) / 4;
  const Window edge = intersect(display, {cx - 60, ball.y0, cx + 60, ball.y0 + 100});
  const CocFunction on_ball = focused_at(static_cast<double>(depth), display);
  const CocFunction in_front = focused_at(static_cast<double>(depth) / 2, display);
  fmt::print("ball x {}..{}, y {}..{}, depth to {}, CoC {:.1f} px when focused in front\n", ball.x0, ball.x1 - 1,
             ball.y0, ball.y1 - 1, depth, in_front(depth));

  Sheet sheet(3, 4);
  const ColourImage sharp = filtered(frame, on_ball, SampleType::half);
  const ColourImage blurred = filtered(frame, in_front, SampleType::half);
  for (int k = 0; k < 3; ++k) {
    sheet.put(k, 0, frame.colour, part, kColours[k]);
    sheet.put(k, 1, sharp, part, kColours[k]);
    sheet.put(k, 2, blurred, part, kColours[k]);
    sheet.put(k, 3, sharp, edge, kColours[k]);
    fmt::print("over {:6} rim {:.2g} focused on the ball, {:.2g} in front of it\n", kNames[k],
               rim(frame, on_ball, kColours[k]), rim(frame, in_front, kColours[k]));
  }
  fmt::print("least alpha on the opaque ball in focus: {:.3f}\n", least_opaque_alpha(frame, sharp));
  imageio::write_picture(sheet_path, sheet.picture());
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
