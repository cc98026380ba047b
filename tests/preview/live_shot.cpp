#include "live_shot.h"

#include <chrono>
#include <thread>

namespace pullfocus::cli::preview::test {

LiveShot::LiveShot(int last) { pullfocus::test::write_shot(folder, 1, last); }

PreviewArguments LiveShot::arguments() const {
  PreviewArguments arguments;
  arguments.input.input = pattern();
  arguments.filter.threads = 2;
  arguments.keys = folder / "keys.toml";
  return arguments;
}

void settle(LiveSession& session) {
  const auto begin = std::chrono::steady_clock::now();
  do {
    session.tick(std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count());
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    ASSERT_LT(std::chrono::steady_clock::now() - begin, std::chrono::minutes(2)) << "the session does not come to rest";
  } while (session.is_playing() || session.is_writing() || !session.is_settled());
}

ColourImage linear_picture(const Shot& shot, std::size_t frame, const Camera& camera, const FilterSetup& setup) {
  ShotFrame read;
  shot.read(shot.sequence().frames[frame], read, false);
  LinearFilter linear(shot.state_window(), setup.options);
  linear.filter(read.frame, camera.coc(shot.sequence().frames[frame].frame, read.file));
  return linear.result();
}

}  // namespace pullfocus::cli::preview::test
