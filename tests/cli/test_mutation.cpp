// Texts that users type or write into files, changed at random: taken as they stand, or refused in one clear line.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <random>

#include "camera_options.h"
#include "config_file.h"
#include "exr/header.h"
#include "exr/pattern.h"
#include "exr/range.h"
#include "exr/state_window.h"
#include "filter/options.h"
#include "image/error.h"
#include "key_file.h"
#include "program.h"

namespace pullfocus {
namespace {

using test::TempFolder;

class Mutator {
 public:
  explicit Mutator(unsigned seed) : random_(seed) {}

  std::size_t below(std::size_t n) { return random_() % n; }

  std::string change(std::string text, const std::vector<std::string>& others) {
    constexpr std::string_view characters = "0123456789-+.,:;@#%xyediInfa \t\n\"'[]=/\\\0\x7f\xc3\xa4";
    static const char* const numbers[] = {"2147483647", "-2147483648", "2147483648", "99999999999",
                                          "1e999",      "1e-320",      "nan",        "-0",
                                          "inf",        "4294967296",  "1e308",      "9223372036854775807"};
    for (std::size_t n = 1 + below(3); n > 0; --n) {
      const std::size_t at = below(text.size() + 1);
      switch (below(6)) {
        case 0:
          text = text.substr(0, at);
          break;
        case 1:
          if (at < text.size()) text.erase(at, 1 + below(3));
          break;
        case 2:
          text.insert(at, numbers[below(std::size(numbers))]);
          break;
        case 3:
          text.insert(at, others[below(others.size())]);
          break;
        default:
          text.insert(at, 1, characters[below(characters.size())]);
      }
    }
    return text;
  }

 private:
  std::mt19937 random_;
};

testing::AssertionResult is_clear(const Error& error, const std::string& names) {
  const std::string message = error.what();
  if (error.code() != ErrorCode::usage) return testing::AssertionFailure() << "no usage error: " << message;
  if (message.find(names) == std::string::npos)
    return testing::AssertionFailure() << "does not say " << names << ": " << message;
  const bool plain = std::ranges::none_of(message, [](char c) { return static_cast<unsigned char>(c) < 0x20; });
  return plain ? testing::AssertionSuccess() : testing::AssertionFailure() << "not one plain line: " << message;
}

// Calls take(text) for many changes of `valid`: it returns, or throws an error that contains `names`.
void mutate(const std::vector<std::string>& valid, const std::string& names, int rounds,
            const std::function<void(const std::string&)>& take) {
  Mutator mutator(21);
  int taken = 0;
  for (const std::string& text : valid) {
    EXPECT_NO_THROW(take(text)) << text;
  }
  for (int round = 0; round < rounds && !testing::Test::HasFailure(); ++round) {
    const std::string text = mutator.change(valid[mutator.below(valid.size())], valid);
    SCOPED_TRACE("'" + text + "'");
    try {
      take(text);
      ++taken;
    } catch (const Error& error) {
      EXPECT_TRUE(is_clear(error, names));
    }
  }
  EXPECT_GT(taken, rounds / 200) << "the changes are too wild";
  EXPECT_LT(taken, rounds) << "the changes are too tame";
}

// Writing over a file waits for the disk on some file systems; a new one does not.
void rewrite(const std::string& path, const std::string& text) {
  std::filesystem::remove(path);
  exr::test::write_bytes(path, text);
}

TEST(Mutation, KeysAreReadBackAsTheyAreSpelt) {
  mutate({"2.8", "inf", "1:2,24:3.5", "-3:0.25,0:1e3,7:inf"}, "--focus", 20000, [](const std::string& text) {
    const KeyedValue value = KeyedValue::parse(text, "--focus", Infinity::legal);
    EXPECT_EQ(KeyedValue::parse(value.to_string(), "--focus", Infinity::legal), value);
    for (const int frame : {-2147483647 - 1, -3, 0, 5, 2147483647})
      EXPECT_GT(value.focus_at(frame, FocusInterp::smooth), 0);
  });
}

TEST(Mutation, BudgetsAreAShareOrANumberOfPixels) {
  mutate({"15%", "100%", "0", "200000", "0.5%"}, "--budget", 20000, [](const std::string& text) {
    const Budget budget = Budget::parse(text);
    const std::int64_t pixels = budget.pixels(1000);
    EXPECT_TRUE(pixels >= (budget.kind == Budget::Kind::percent ? 1 : 0) && pixels <= 1000) << pixels;
    EXPECT_GE(budget.longest_wait(), 0);
  });
}

TEST(Mutation, FrameRangesAreReadBackAsTheyAreWritten) {
  mutate({"7", "1-10", "10-1x3", "-10--5", "1-20y4,30"}, "frame range", 10000, [](const std::string& text) {
    const std::vector<int> frames = exr::parse_frames(text);
    ASSERT_FALSE(frames.empty());
    if (frames.size() > 10000) return;
    EXPECT_EQ(exr::parse_frames(exr::format_frames(frames)), frames);
  });
}

TEST(Mutation, PatternsNameAFileForEveryFrame) {
  mutate({"a/shot.####.exr", "shot.%04d.exr", "shot.1-5#.exr", "shot.@@@.exr", "shot.exr"}, "", 10000,
         [](const std::string& text) {
           const exr::Pattern pattern = exr::Pattern::parse(text);
           const std::string path = pattern.path(-2147483647 - 1);
           EXPECT_EQ(path == text, pattern.is_single());
           if (pattern.is_single()) pattern.single_frame();
         });
}

TEST(Mutation, OverscanIsFourMarginsOrAuto) {
  mutate({"auto", "0,0,0,0", "1,20,300,1048576"}, "--overscan", 10000, [](const std::string& text) {
    const exr::Overscan overscan = exr::parse_overscan(text);
    for (const int margin : {overscan.left, overscan.top, overscan.right, overscan.bottom}) {
      EXPECT_TRUE(margin >= 0 && margin <= 1 << 20) << margin;
    }
  });
}

TEST(Mutation, AFocusPixelIsTheOneThatIsSpelt) {
  mutate({"960,540", "-3,7@12", "0,0@-1"}, "--focus-at", 10000, [](const std::string& text) {
    const cli::FocusPixel pixel = cli::FocusPixel::parse(text);
    std::string spelt = std::to_string(pixel.x) + "," + std::to_string(pixel.y);
    if (pixel.frame) spelt += "@" + std::to_string(*pixel.frame);
    std::string plain;  // without leading zeros and the minus of a zero
    for (std::size_t i = 0; i < text.size(); ++i) {
      const bool first =
          i == 0 || text[i - 1] == ',' || text[i - 1] == '@' || (text[i - 1] == '-' && plain.back() == '-');
      const bool more = i + 1 < text.size() && std::isdigit(static_cast<unsigned char>(text[i + 1]));
      if (text[i] == '0' && more &&
          (first || plain.empty() || !std::isdigit(static_cast<unsigned char>(plain.back())))) {
        continue;
      }
      plain += text[i];
    }
    for (std::size_t at; (at = plain.find("-0")) != std::string::npos;) plain.erase(at, 1);
    EXPECT_EQ(spelt, plain);
  });
}

TEST(Mutation, KeyFilesLoadWhatTheySay) {
  const TempFolder folder;
  const std::string path = folder / "keys.toml";
  mutate({"focus = [[1, 0.4], [24, inf]]\nfstop = 2\n",
          "interpolation = \"smooth\"\nfocal_length = [[1, 50], [24, 85]]\n", "fstop = 2.8 # wide\n"},
         path, 3000, [&](const std::string& text) {
           rewrite(path, text);
           const CameraKeys keys = load_camera_keys(path);
           std::filesystem::remove(folder / "saved.toml");
           save_camera_keys(keys, folder / "saved.toml");
           EXPECT_EQ(load_camera_keys(folder / "saved.toml"), keys);
         });
}

TEST(Mutation, ConfigFilesBecomeOptions) {
  const TempFolder folder;
  const std::string path = folder / "options.toml";
  mutate({"fstop = 2.8\nfocus = \"1:2,5:3\"\n", "strict = true\noverscan = [1, 2, 3, 4]\n", "budget = '15%'\n"}, path,
         3000, [&](const std::string& text) {
           rewrite(path, text);
           const auto arguments = cli::expand_config({"filter", "--config", path});
           ASSERT_GE(arguments.size(), 1u);
           for (std::size_t i = 1; i < arguments.size(); ++i)
             EXPECT_TRUE(arguments[i].starts_with("--")) << arguments[i];
         });
}

TEST(Mutation, TheProgramTakesOptionsOrRefusesThemInOneLine) {
  const TempFolder folder;
  test::write_shot(folder, 1, 2);
  const std::vector<std::string> options{"--focus 1:2,2:3",    "--budget 15%",     "--frames 1-2",
                                         "--overscan 0,1,2,3", "--max-coc 40",     "--coc-step 0.03",
                                         "--threads 1",        "--focus-at 3,4@1", "--output-type half",
                                         "--max-radiance 9",   "--w-rgb 0.25",     "--rgb-threshold 0.1"};
  Mutator mutator(22);
  int done = 0, refused = 0;
  for (int round = 0; round < 60; ++round) {
    std::string option = mutator.change(options[mutator.below(options.size())], {"x", "-", "5"});
    std::erase_if(option, [](char c) { return c == '\'' || c == '\0' || c == '\n'; });
    const std::size_t blank = std::min(option.find(' '), option.size());
    const std::string command = "filter '" + (folder / "shot.####.exr") + "' -o '" + (folder / "out") + "' --mkdir '" +
                                option.substr(0, blank) + "' '" + option.substr(std::min(blank + 1, option.size())) +
                                "'";
    const test::Outcome outcome = test::run(command);
    ASSERT_TRUE(outcome.code >= 0 && outcome.code <= 2) << command << "\n" << outcome.err;
    ++(outcome.code == 0 ? done : refused);
    if (outcome.code != 0) {
      EXPECT_EQ(outcome.error_lines(), 1u) << command << "\n" << outcome.err;
      EXPECT_TRUE(outcome.err.starts_with("pullfocus: ")) << outcome.err;
    }
  }
  EXPECT_GT(done, 0);
  EXPECT_GT(refused, 0);
}

}  // namespace
}  // namespace pullfocus
