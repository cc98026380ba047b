// The command line that a session gives.
#include <gtest/gtest.h>

#include <cmath>

#include "preview/command_text.h"

namespace pullfocus::cli::preview {
namespace {

TEST(CommandText, NamesOnlyWhatIsNotAsByDefault) {
  InputArguments input;
  input.input = "shot.####.exr";
  EXPECT_EQ(shell_line(filter_arguments(input, {}, {}, {}, "out/")), "pullfocus filter 'shot.####.exr' --out out/");
}

TEST(CommandText, HoldsEveryOptionThatThePictureDependsOn) {
  InputArguments input{"in.exr", "1-10", "main", "left", "Z", "hold", "1,2,3,4", true};
  CameraArguments camera;
  camera.lens = "paper";
  camera.sensor_width = 24.5;
  camera.sensor_fit = "auto";
  camera.unit = 0.01;
  camera.near_scale = 0.5;
  camera.far_scale = 2;
  CameraKeys keys;
  keys.interpolation = FocusInterp::smooth;
  keys.focus = KeyedValue({{1, 0.1}, {9, INFINITY}}, "focus", Infinity::legal);
  keys.fstop = KeyedValue(2.8, "fstop", Infinity::refused);
  keys.focal_length = KeyedValue(50, "focal length", Infinity::refused);
  FilterArguments filter;
  filter.kernel = {"polygon:5", 15, 0.25};
  filter.visibility = "layers:-3,3";
  filter.cutoff = 4;
  filter.coc_step = 0;
  filter.max_coc = 100;
  filter.max_radiance = 10;
  filter.output_type = "float";
  filter.threads = 3;
  EXPECT_EQ(shell_line(filter_arguments(input, camera, keys, filter, "o")),
            "pullfocus filter in.exr --out o --frames=1-10 --layer=main --view=left --depth-channel=Z --mask=hold "
            "--overscan=1,2,3,4 --repair-depth --focus=1:0.1,9:inf --focus-interp=smooth --fstop=2.8 --focal-length=50 "
            "--lens=paper --sensor-width=24.5 --sensor-fit=auto --unit=0.01 --near-scale=0.5 --far-scale=2 "
            "--kernel=polygon:5 --blade-rotation=15 --blade-roundness=0.25 --visibility=layers:-3,3 --cutoff=4 "
            "--coc-step=0 --max-coc=100 --max-radiance=10 --output-type=float --threads=3");
}

TEST(CommandText, QuotesWhatAShellWouldTakeApart) {
  EXPECT_EQ(shell_line({"a b", "it's", "", "$x", "plain-1.exr"}), R"(pullfocus 'a b' 'it'\''s' '' '$x' plain-1.exr)");
}

}  // namespace
}  // namespace pullfocus::cli::preview
