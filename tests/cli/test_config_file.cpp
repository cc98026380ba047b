#include "config_file.h"

#include <gtest/gtest.h>

#include "program.h"
#include "usage.h"

namespace pullfocus::cli {
namespace {

using test::TempFolder;

std::vector<std::string> expand(const TempFolder& folder, const std::string& toml) {
  exr::test::write_bytes(folder / "c.toml", toml);
  return expand_config({"filter", "in.exr", "--config", folder / "c.toml", "--fstop", "8"});
}

TEST(ConfigFile, EntriesBecomeOptionsBeforeThoseOfTheCommandLine) {
  const TempFolder folder;
  const auto arguments =
      expand(folder, "fstop = 2.8\nfocus = \"1:2,5:3\"\nstrict = true\nmkdir = false\noverscan = [1, 2, 3, 4]\n");
  const std::vector<std::string> expected{"filter",   "--focus=1:2,5:3", "--fstop=2.8", "--overscan=1,2,3,4",
                                          "--strict", "in.exr",          "--fstop",     "8"};
  EXPECT_EQ(arguments, expected);
}

TEST(ConfigFile, TheCommandLineWins) {
  const TempFolder folder;
  test::write_shot(folder, 1, 1);
  exr::test::write_bytes(folder / "c.toml", "fstop = 0\n");
  const std::string command = "filter '" + (folder / "shot.####.exr") + "' -o '" + (folder / "o.exr") + "' --config '" +
                              (folder / "c.toml") + "'";
  EXPECT_EQ(test::run(command).code, 2);
  EXPECT_EQ(test::run(command + " --fstop 2").code, 0);
}

TEST(ConfigFile, MistakesNameTheFile) {
  const TempFolder folder;
  expect_usage_error([&] { expand(folder, "fstop = = 3"); }, "c.toml:1");
  expect_usage_error([&] { expand(folder, "fstop = { a = 1 }"); }, "fstop");
  expect_usage_error([&] { expand_config({"filter", "--config", "/no/such.toml"}); }, "/no/such.toml");
  expect_usage_error([&] { expand_config({"filter", "--config"}); }, "--config");
  const auto unknown = test::run("filter x -o y --config '" + (folder / "u.toml") + "'");
  EXPECT_EQ(unknown.code, 2);
}

}  // namespace
}  // namespace pullfocus::cli
