// Files from renderers, kept beside the source tree; skipped where they are not.
#include <algorithm>
#include <cmath>
#include <filesystem>

#include "exr/exr_files.h"
#include "exr/reader.h"
#include "exr/sequence.h"
#include "exr/state_window.h"

namespace pullfocus::exr {
namespace {

const std::string data = PULLFOCUS_SOURCE_DIR "/../shared/data";

#define REQUIRE_DATA(folder) \
  if (!std::filesystem::is_directory(data + "/" + (folder))) GTEST_SKIP() << data << "/" << (folder) << " is not there"

TEST(RealFiles, BeachballIsOneShotWithAMovingDataWindow) {
  REQUIRE_DATA("beachball");
  const Sequence sequence = open_sequence(Pattern::parse(data + "/beachball/singlepart.####.exr"), "");
  ASSERT_EQ(sequence.frames.size(), 8u);
  EXPECT_TRUE(sequence.gaps.empty());
  EXPECT_EQ(sequence.display_window, (Window{0, 0, 2048, 1556}));
  EXPECT_EQ(sequence.frames[0].data_window, (Window{654, 245, 1565, 1121}));
  const Window state = state_window(sequence.display_window, sequence.data_union, {});
  EXPECT_EQ(state.x0, 0);
  EXPECT_GT(state.x1, 2048);
}

TEST(RealFiles, BeachballViewsAreReadWithEmptyPixelsAsStored) {
  REQUIRE_DATA("beachball");
  for (const char* view : {"right", "left"}) {
    FrameReader reader(data + "/beachball/singlepart.0001.exr");
    const Selection selection = select_channels(reader.info().channel_names(), {.view = view});
    EXPECT_EQ(selection.colour[0].output_name, "R");
    Frame frame;
    ExtraChannels extra;
    EXPECT_EQ(reader.read(selection, reader.info().display_window, frame, &extra), 0u);
    EXPECT_EQ(frame.colour.type(), SampleType::half);
    EXPECT_EQ(frame.depth.at(0, 0), INFINITY);
    EXPECT_EQ(frame.depth.at(654, 245), 0);  // inside the data, nothing hit
    EXPECT_EQ(frame.colour.get(654, 245, 3), 0);
    EXPECT_GT(frame.depth.at(1100, 680), 0);
    EXPECT_EQ(frame.colour.get(1100, 680, 3), 1);
    // Z, two disparities, motion of this view; not the other view's channels.
    EXPECT_NE(std::find_if(extra.channels.begin(), extra.channels.end(),
                           [](const ExtraChannel& channel) { return channel.name == "whitebarmask.mask"; }),
              extra.channels.end());
  }
}

TEST(RealFiles, BeachballFramesPastTheDisplayWindowAreCounted) {
  REQUIRE_DATA("beachball");
  FrameReader reader(data + "/beachball/singlepart.0008.exr");
  const Window inside = intersect(reader.info().data_window, reader.info().display_window);
  Frame frame;
  ExtraChannels extra;
  const Selection selection = select_channels(reader.info().channel_names(), {});
  const std::size_t outside = reader.read(selection, reader.info().display_window, frame, &extra);
  EXPECT_GT(outside, 0u);
  EXPECT_EQ(outside, reader.info().data_window.pixels() - inside.pixels());
  EXPECT_EQ(extra.window, inside);
}

TEST(RealFiles, CyclesHasHalfColourAndFloatDepth) {
  REQUIRE_DATA("cycles");
  const std::string path = data + "/cycles/static_pull/pinhole_0001.exr";
  Frame frame;
  EXPECT_EQ(read_frame(path, {}, {0, 0, 480, 270}, frame, nullptr), 0u);
  EXPECT_EQ(frame.colour.type(), SampleType::half);
  EXPECT_TRUE(frame.has_alpha);
  EXPECT_EQ(frame.colour.get(240, 135, 3), 1);
  for (int x = 0; x < 480; ++x) EXPECT_GT(frame.depth.at(x, 135), 0);
}

TEST(RealFiles, CyclesMoverHasTwelveFrames) {
  REQUIRE_DATA("cycles/mover");
  const Sequence sequence = open_sequence(Pattern::parse(data + "/cycles/mover/pinhole_%04d.exr"), "2-12x5");
  ASSERT_EQ(sequence.frames.size(), 3u);
  EXPECT_EQ(sequence.frames[2].frame, 12);
  EXPECT_EQ(sequence.data_union, (Window{0, 0, 480, 270}));
}

}  // namespace
}  // namespace pullfocus::exr
