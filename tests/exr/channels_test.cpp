#include "exr/channels.h"

#include <algorithm>

#include "exr/exr_files.h"

namespace pullfocus::exr {
namespace {

using Strings = std::vector<std::string>;

Selection select(const Strings& channels, const ChannelOptions& options = {}, const Strings& views = {}) {
  return select_channels({"shot.exr", channels, views}, options);
}

void expect_failure(ErrorCode code, const Strings& parts, const Strings& channels, const ChannelOptions& options = {},
                    const Strings& views = {}) {
  test::expect_error(code, parts, [&] { select(channels, options, views); });
}

Strings with_layers(const Strings& layers) {
  Strings channels;
  for (const std::string& layer : layers) {
    for (const char* base : {"B", "G", "R"}) channels.push_back(layer.empty() ? base : layer + "." + base);
  }
  return channels;
}

Strings operator+(Strings a, const Strings& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

Strings extra_names(const Selection& selection) {
  Strings names;
  for (const NamedChannel& channel : selection.extra) names.push_back(channel.output_name);
  return names;
}

TEST(Channels, RootColourAndDepthAreFoundInAnyOrder) {
  const Selection selection = select({"Z", "B", "A", "R", "G", "id"});
  EXPECT_EQ(selection.layer, "");
  EXPECT_EQ(selection.colour, (std::vector<NamedChannel>{{"R", "R"}, {"G", "G"}, {"B", "B"}, {"A", "A"}}));
  EXPECT_TRUE(selection.has_alpha());
  EXPECT_EQ(selection.depth, "Z");
  EXPECT_EQ(extra_names(selection), (Strings{"Z", "id"}));
}

TEST(Channels, AlphaIsOptional) { EXPECT_FALSE(select({"R", "G", "B", "Z"}).has_alpha()); }

TEST(Channels, RootLayerComesFirst) {
  EXPECT_EQ(select(with_layers({"", "diffuse", "V.Combined"}) + Strings{"Z"}).layer, "");
}

TEST(Channels, OnlyLayerWithColourIsTaken) {
  EXPECT_EQ(select(with_layers({"diffuse"}) + Strings{"Z", "N.X", "N.Y"}).layer, "diffuse");
}

TEST(Channels, CombinedIsTakenAmongSeveral) {
  EXPECT_EQ(select(with_layers({"V.DiffCol", "V.Combined"}) + Strings{"V.Depth.Z"}).layer, "V.Combined");
  EXPECT_EQ(select(with_layers({"diffuse", "Beauty"}) + Strings{"Z"}).layer, "Beauty");
  EXPECT_EQ(select(with_layers({"diffuse", "RGBA"}) + Strings{"Z"}).layer, "RGBA");
}

TEST(Channels, AmbiguousColourListsTheLayers) {
  expect_failure(ErrorCode::usage, {"shot.exr", "--layer", "A.Combined, B.Combined"},
                 with_layers({"A.Combined", "B.Combined"}));
}

TEST(Channels, LayerOptionTakesTheFullNameOrItsEnd) {
  const Strings channels = with_layers({"", "V.Combined", "V.DiffCol", "W.Combined"}) + Strings{"Z"};
  EXPECT_EQ(select(channels, {.layer = "V.Combined"}).layer, "V.Combined");
  EXPECT_EQ(select(channels, {.layer = "DiffCol"}).layer, "V.DiffCol");
  EXPECT_EQ(select(channels, {.layer = ""}).layer, "");
  EXPECT_EQ(select(with_layers({"Combined", "W.Combined"}) + Strings{"Z"}, {.layer = "Combined"}).layer, "Combined");
  expect_failure(ErrorCode::usage, {"--layer Combined", "V.Combined"}, channels, {.layer = "Combined"});
  expect_failure(ErrorCode::usage, {"--layer ombined", "(root)"}, channels, {.layer = "ombined"});
  expect_failure(ErrorCode::usage, {"--layer none"}, channels, {.layer = "none"});
}

TEST(Channels, WithoutColourTheChannelsAreListed) {
  expect_failure(ErrorCode::unreadable, {"no layer has R, G and B", "G, R, Z"}, {"G", "R", "Z"});
  expect_failure(ErrorCode::unreadable, {"luminance"}, {"Y", "Z"});
}

TEST(Channels, DepthOfTheColoursOwnLayerComesFirst) {
  EXPECT_EQ(select(with_layers({"L"}) + Strings{"L.Z", "Z", "Depth.Z"}).depth, "L.Z");
}

TEST(Channels, DepthBesideTheColourLayerComesBeforeRoot) {
  EXPECT_EQ(select(with_layers({"V.Combined"}) + Strings{"V.Depth.Z", "W.Depth.Z", "Z"}).depth, "V.Depth.Z");
  EXPECT_EQ(select(with_layers({"V.Combined"}) + Strings{"V.Depth.V"}).depth, "V.Depth.V");
  EXPECT_EQ(select(with_layers({"beauty"}) + Strings{"depth.Z", "x.Z"}).depth, "depth.Z");
}

TEST(Channels, RootDepthComesBeforeOthers) {
  EXPECT_EQ(select(with_layers({""}) + Strings{"Z", "depth", "other.Z"}).depth, "Z");
}

TEST(Channels, OnlyCandidateIsDepth) {
  EXPECT_EQ(select(with_layers({""}) + Strings{"depth"}).depth, "depth");
  EXPECT_EQ(select(with_layers({""}) + Strings{"depth.Z"}).depth, "depth.Z");
  EXPECT_EQ(select(with_layers({""}) + Strings{"V.Depth.V"}).depth, "V.Depth.V");
  EXPECT_EQ(select(with_layers({""}) + Strings{"any.Z", "ZBack"}).depth, "any.Z");
}

TEST(Channels, ZOfAVectorIsNotDepth) {
  const Strings normal = {"V.Normal.X", "V.Normal.Y", "V.Normal.Z"};
  EXPECT_EQ(select(with_layers({"V.Combined"}) + normal + Strings{"V.Depth.Z"}).depth, "V.Depth.Z");
  EXPECT_EQ(select(with_layers({"V.Combined"}) + normal + Strings{"W.dist.Z"}).depth, "W.dist.Z");
  expect_failure(ErrorCode::unreadable, {"no depth channel", "V.Normal.Z"}, with_layers({"V.Combined"}) + normal);
}

TEST(Channels, TwoPossibleDepthsAreNamed) {
  expect_failure(ErrorCode::usage, {"--depth-channel", "a.Z, b.Z"}, with_layers({""}) + Strings{"a.Z", "b.Z"});
}

TEST(Channels, MissingDepthNamesFileAndChannels) {
  expect_failure(ErrorCode::unreadable, {"shot.exr", "(Z)", "B, G, R, id", "--depth-channel"},
                 with_layers({""}) + Strings{"id"});
}

TEST(Channels, DepthOptionTakesAnyChannel) {
  const Strings channels = with_layers({"", "WorldDepth"}) + Strings{"A", "Z"};
  EXPECT_EQ(select(channels, {.depth_channel = "WorldDepth.R"}).depth, "WorldDepth.R");
  expect_failure(ErrorCode::usage, {"--depth-channel z", "WorldDepth.R"}, channels, {.depth_channel = "z"});
  expect_failure(ErrorCode::usage, {"--depth-channel R", "colour"}, channels, {.depth_channel = "R"});
}

TEST(Channels, DepthStoredInAlphaLeavesNoAlpha) {
  const Selection selection = select({"R", "G", "B", "A"}, {.depth_channel = "A"});
  EXPECT_FALSE(selection.has_alpha());
  EXPECT_EQ(selection.depth, "A");
  EXPECT_EQ(extra_names(selection), Strings{"A"});
}

const Strings stereo = {"A",           "B",           "G",      "R",      "Z",      "left.A",
                        "left.B",      "left.G",      "left.R", "left.Z", "misc.x", "mask.left.id",
                        "spec.left.R", "spec.right.R"};

TEST(Channels, DefaultViewIsTheFirstListed) {
  const Selection selection = select(stereo, {}, {"right", "left"});
  EXPECT_EQ(selection.view, "right");
  EXPECT_EQ(selection.colour.front(), (NamedChannel{"R", "R"}));
  EXPECT_EQ(selection.depth, "Z");
  EXPECT_EQ(extra_names(selection), (Strings{"Z", "misc.x", "spec.R"}));
}

TEST(Channels, OtherViewIsWrittenWithoutItsName) {
  const Selection selection = select(stereo, {.view = "left"}, {"right", "left"});
  EXPECT_EQ(selection.view, "left");
  EXPECT_EQ(selection.layer, "");
  EXPECT_EQ(selection.colour,
            (std::vector<NamedChannel>{{"left.R", "R"}, {"left.G", "G"}, {"left.B", "B"}, {"left.A", "A"}}));
  EXPECT_EQ(selection.depth, "left.Z");
  EXPECT_EQ(extra_names(selection), (Strings{"Z", "mask.id", "misc.x", "spec.R"}));
}

TEST(Channels, DepthOptionIsLookedUpInTheViewFirst) {
  const auto depth = [](const char* name) {
    return select(stereo, {.view = "left", .depth_channel = name}, {"right", "left"}).depth;
  };
  EXPECT_EQ(depth("Z"), "left.Z");
  EXPECT_EQ(depth("left.Z"), "left.Z");
  EXPECT_EQ(depth("spec.right.R"), "spec.right.R");
}

TEST(Channels, WithoutAViewListDottedNamesAreLayers) {
  EXPECT_EQ(select(stereo, {.layer = "left"}).colour.front(), (NamedChannel{"left.R", "left.R"}));
}

TEST(Channels, UnknownViewListsTheViews) {
  expect_failure(ErrorCode::usage, {"'middle'", "right, left"}, stereo, {.view = "middle"}, {"right", "left"});
  expect_failure(ErrorCode::usage, {"has no views", "--view left"}, stereo, {.view = "left"});
}

TEST(Channels, AMaskIsFoundByItsNameItsViewsNameOrItsLastComponents) {
  const Strings channels = {"R", "G", "B", "A", "Z", "matte.hold", "fx.matte.hold2", "left.hold3"};
  EXPECT_EQ(select(channels).mask, "");
  EXPECT_EQ(select(channels, {.mask = "matte.hold"}).mask, "matte.hold");
  EXPECT_EQ(select(channels, {.mask = "hold2"}).mask, "fx.matte.hold2");
  EXPECT_EQ(select(channels, {.mask = "A"}).mask, "A");
  const Strings views = {"right", "left"};
  const Strings left = {"left.R", "left.G", "left.B", "left.Z"};
  EXPECT_EQ(select(channels + left, {.view = "left", .mask = "hold3"}, views).mask, "left.hold3");
  // It is carried along like any other channel.
  const Strings extra = extra_names(select(channels, {.mask = "hold2"}));
  EXPECT_NE(std::ranges::find(extra, "fx.matte.hold2"), extra.end());
}

TEST(Channels, AMaskThatIsMissingOrOneOfSeveralIsRefusedByName) {
  const Strings channels = {"R", "G", "B", "Z", "a.hold", "b.hold"};
  expect_failure(ErrorCode::usage, {"shot.exr", "--mask holdout", "no such channel", "a.hold"}, channels,
                 {.mask = "holdout"});
  expect_failure(ErrorCode::usage, {"shot.exr", "--mask hold:", "several", "a.hold, b.hold"}, channels,
                 {.mask = "hold"});
}

}  // namespace
}  // namespace pullfocus::exr
