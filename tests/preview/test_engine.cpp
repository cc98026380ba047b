// The filter on its thread.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <filesystem>
#include <future>
#include <random>
#include <thread>

#include "live_shot.h"

namespace pullfocus::cli::preview {
namespace {

using test::linear_picture;
using test::LiveShot;

// An engine over a shot, and its wishes.
struct Running {
  explicit Running(const LiveShot& files, CameraArguments camera_arguments = {})
      : shot(files.arguments().input, camera_arguments, exr::BadFrames::keep),
        cache(shot, 1 << 30, [this] { engine.on_read(); }),
        engine(shot, cache, [] {}) {
    setup_of("disc", "auto");
  }
  ~Running() { cache.stop(); }

  void setup_of(const std::string& kernel, const std::string& visibility) {
    FilterArguments arguments;
    arguments.kernel.kernel = kernel;
    arguments.visibility = visibility;
    arguments.threads = 2;
    auto made = std::make_shared<FilterSetup>();
    made->options = filter_options(arguments, {1, {}, {}});
    setup = made;
  }
  Wish wish(std::size_t frame, std::optional<double> focus = std::nullopt) {
    Camera camera = shot.camera();
    if (focus) {
      CameraKeys keys = camera.keys();
      keys.focus = KeyedValue(*focus, "focus", Infinity::legal);
      camera.set_keys(keys);
    }
    return {++id, frame, std::make_shared<Camera>(camera), setup, Budget::parse("16ms"), true, false, {}};
  }
  void settle() {
    for (int i = 0; i < 60000 && !engine.is_settled(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    ASSERT_TRUE(engine.is_settled());
  }
  // The picture of a wish through finish().
  ColourImage finished(const Wish& wish, std::string* problem = nullptr) {
    std::promise<ColourImage> promise;
    engine.finish(wish, [&](const Exact* exact, const std::string& why) {
      if (problem != nullptr) *problem = why;
      promise.set_value(exact != nullptr ? exact->colour : ColourImage{});
    });
    return promise.get_future().get();
  }

  Shot shot;
  std::shared_ptr<const FilterSetup> setup;
  std::uint64_t id = 0;
  FrameCache cache;
  Engine engine;
};

TEST(Engine, EndsAtTheLinearPictureOfTheLastWishWhateverCameBefore) {
  const LiveShot files(4);
  Running run(files);
  std::mt19937 random(7);
  const auto below = [&](std::size_t n) { return std::uniform_int_distribution<std::size_t>(0, n - 1)(random); };
  const char* const kernels[] = {"disc", "polygon:5"};
  const char* const visibilities[] = {"auto", "none", "bitmap:16"};
  for (int round = 0; round < 40; ++round) {
    Wish last;
    for (std::size_t n = below(4); n < 4; ++n) {
      if (below(6) == 0) run.setup_of(kernels[below(2)], visibilities[below(3)]);
      last = run.wish(below(4), 1.5 + static_cast<double>(below(30)) / 10);
      last.hurried = below(2) == 0;
      last.refine = below(4) != 0;
      if (below(3) == 0) last.budget = Budget::parse("10%");
      last.look.view = static_cast<View>(below(kViews));
      run.engine.want(last);
      if (below(2) == 0) std::this_thread::sleep_for(std::chrono::milliseconds(below(4)));
    }
    if (below(3) == 0) run.settle();
    EXPECT_EQ(run.finished(last), linear_picture(run.shot, last.frame, *last.camera, *last.setup)) << "round " << round;
  }
}

TEST(Engine, ShowsTheLastWishOnceSettled) {
  const LiveShot files(4);
  Running run(files);
  for (int round = 0; round < 20; ++round) {
    for (int n = 0; n < 5; ++n) run.engine.want(run.wish(static_cast<std::size_t>((round + n) % 4), 2 + 0.1 * n));
    run.settle();
    const auto shown = run.engine.shown();
    EXPECT_EQ(shown->request, run.id);
    EXPECT_EQ(shown->frame, static_cast<std::size_t>((round + 4) % 4));
    EXPECT_TRUE(shown->exact);
    EXPECT_EQ(shown->left.pixels, 0);
    ASSERT_NE(shown->picture, nullptr);
    EXPECT_EQ(shown->picture->width, 24);
  }
}

TEST(Engine, WithoutRefiningLeavesWhatTheBudgetDoesAndTellsHowFarOffThatIs) {
  const LiveShot files(2);
  Running run(files);
  run.engine.want(run.wish(0));
  run.settle();
  Wish wish = run.wish(1);
  wish.refine = false;
  wish.budget = Budget::parse("20%");
  run.engine.want(wish);
  run.settle();
  const auto partial = run.engine.shown();
  EXPECT_FALSE(partial->exact);
  EXPECT_GT(partial->left.pixels, 0);
  EXPECT_GT(partial->left.error_bound, 0);
  EXPECT_EQ(partial->calls, 1);
  wish.id = ++run.id;
  wish.refine = true;
  run.engine.want(wish);
  run.settle();
  EXPECT_TRUE(run.engine.shown()->exact);
  EXPECT_GT(run.engine.shown()->calls, 1) << "it went on from there";
}

TEST(Engine, ShowsNoDifferenceToTheFullPictureOnceExact) {
  const LiveShot files(2);
  Running run(files);
  run.engine.want(run.wish(0));
  run.settle();
  Wish wish = run.wish(1);
  wish.look.view = View::difference;
  wish.look.exposure = 10;
  wish.refine = false;
  wish.budget = Budget::parse("1");
  run.engine.want(wish);
  run.settle();
  const auto bright = [](const Picture& picture) {
    return std::count_if(picture.rgba.begin(), picture.rgba.end(), [](std::uint32_t p) { return (p & 0xffffff) != 0; });
  };
  EXPECT_GT(bright(*run.engine.shown()->picture), 0);
  wish.id = ++run.id;
  wish.refine = true;
  run.engine.want(wish);
  run.settle();
  EXPECT_EQ(bright(*run.engine.shown()->picture), 0);
}

TEST(Engine, ShowsAnotherViewWithoutFilteringAgain) {
  const LiveShot files(2);
  Running run(files);
  run.engine.want(run.wish(0));
  run.settle();
  const auto before = run.engine.shown();
  Wish wish = run.wish(0);
  wish.look.view = View::coc;
  run.engine.want(wish);
  run.settle();
  EXPECT_NE(run.engine.shown()->picture_id, before->picture_id);
  EXPECT_EQ(run.engine.shown()->calls, before->calls);
  EXPECT_EQ(run.engine.shown()->total_ms, before->total_ms);
}

TEST(Engine, ShowsTheInputAndSaysWhyWhileTheCameraIsNotComplete) {
  const LiveShot files(2);
  Running run(files);
  Wish wish = run.wish(0);
  CameraArguments paper;
  paper.lens = "paper";
  paper.focus = "0.01";  // nearer than the focal length
  wish.camera = std::make_shared<Camera>(paper);
  run.engine.want(wish);
  run.settle();
  EXPECT_NE(run.engine.shown()->problem, "");
  ASSERT_NE(run.engine.shown()->picture, nullptr);
  std::string why;
  wish.id = ++run.id;
  EXPECT_TRUE(run.finished(wish, &why).window().empty());
  EXPECT_EQ(why, run.engine.shown()->problem);
  const Wish good = run.wish(0);
  run.engine.want(good);
  run.settle();
  EXPECT_EQ(run.engine.shown()->problem, "");
  EXPECT_TRUE(run.engine.shown()->exact);
}

TEST(Engine, GoesOnWithWhatIsWantedAfterABadFrame) {
  const LiveShot files(3);
  Running run(files);
  std::filesystem::remove(files.folder / "shot.0002.exr");
  run.engine.want(run.wish(1));
  run.settle();
  EXPECT_NE(run.engine.shown()->problem.find("shot.0002.exr"), std::string::npos) << run.engine.shown()->problem;
  const Wish wish = run.wish(2);
  run.engine.want(wish);
  run.settle();
  EXPECT_EQ(run.engine.shown()->problem, "");
  EXPECT_EQ(run.finished(wish), linear_picture(run.shot, 2, *wish.camera, *wish.setup));
}

TEST(Engine, EndsWhileReadingOrRefining) {
  const LiveShot files(4);
  for (int i = 0; i < 30; ++i) {
    Running run(files);
    for (int n = 0; n <= i % 3; ++n) run.engine.want(run.wish(static_cast<std::size_t>(i % 4), 2 + 0.05 * i));
    std::this_thread::sleep_for(std::chrono::microseconds(300 * i));
  }
}

}  // namespace
}  // namespace pullfocus::cli::preview
