#include "bench/measured_shots.h"

#include <cmath>

#include "star_lateral.h"

namespace pullfocus::cli::bench {

namespace {

constexpr int kSide = 256;

CocFunction focused_at(double metres, double f_number) {
  ThinLens lens = sequences::star_lens({});
  lens.focus_distance = metres;
  lens.f_number = f_number;
  return coc_function(lens, {kSide, kSide, 1}, DepthKind::planar);
}

double between_in_dioptres(double from, double to, double t) { return 1 / (1 / from + (1 / to - 1 / from) * t); }

double part(std::size_t i, int frames) { return static_cast<double>(i) / (frames - 1); }

MeasuredShot still(const char* name, const char* description, int frames) {
  MeasuredShot shot{name, description, std::vector<Frame>(static_cast<std::size_t>(frames)), {}};
  const sequences::StarLateralRenderer renderer(sequences::StarLateral{});
  renderer.render(50, shot.frames[0]);
  std::fill(shot.frames.begin() + 1, shot.frames.end(), shot.frames[0]);
  return shot;
}

}  // namespace

MeasuredShot star_shot(int frames) {
  MeasuredShot shot{
      "star", "a sharp star crosses the picture", std::vector<Frame>(static_cast<std::size_t>(frames)), {}};
  const sequences::StarLateralRenderer renderer(sequences::StarLateral{});
  for (std::size_t i = 0; i < shot.frames.size(); ++i) renderer.render(static_cast<int>(i) + 1, shot.frames[i]);
  shot.coc.assign(shot.frames.size(), focused_at(0.04, 3.5));
  return shot;
}

MeasuredShot slow_pull(int frames) {
  MeasuredShot shot = still("slow pull", "focus from 40 to 48 mm", frames);
  for (std::size_t i = 0; i < shot.frames.size(); ++i) {
    shot.coc.push_back(focused_at(between_in_dioptres(0.040, 0.048, part(i, frames)), 3.5));
  }
  return shot;
}

MeasuredShot fast_pull(int frames) {
  MeasuredShot shot = still("fast pull", "focus from 21 to 150 mm in a quarter of the frames", frames);
  for (std::size_t i = 0; i < shot.frames.size(); ++i) {
    const double t = std::min(4 * part(i, frames), 1.0);
    shot.coc.push_back(focused_at(between_in_dioptres(0.021, 0.150, t), 3.5));
  }
  return shot;
}

MeasuredShot light_change(int frames) {
  MeasuredShot shot = still("light", "a pool of light crosses the picture", frames);
  for (std::size_t i = 0; i < shot.frames.size(); ++i) {
    Frame& frame = shot.frames[i];
    const double centre = kSide * (0.1 + 0.8 * part(i, frames));
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) {
        const double dx = (x - centre) / kSide, dy = (y - kSide / 2.0) / kSide;
        const double light = 0.3 + 1.2 * std::exp(-(dx * dx + dy * dy) / 0.06);
        for (int c = 0; c < 3; ++c) {
          frame.colour.set(x, y, c, static_cast<float>(static_cast<double>(frame.colour.get(x, y, c)) * light));
        }
      }
    }
    shot.coc.push_back(focused_at(0.04, 3.5));
  }
  return shot;
}

MeasuredShot reversed_pull(int frames) {
  MeasuredShot shot = still("reversed pull", "focus from 150 to 21 mm at f/12", frames);
  for (std::size_t i = 0; i < shot.frames.size(); ++i) {
    shot.coc.push_back(focused_at(between_in_dioptres(0.150, 0.021, part(i, frames)), 12));
  }
  return shot;
}

}  // namespace pullfocus::cli::bench
