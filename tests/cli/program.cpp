#include "program.h"

#include <OpenEXR/ImfStandardAttributes.h>
#include <fmt/format.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <filesystem>

namespace pullfocus::test {

std::size_t Outcome::error_lines() const { return static_cast<std::size_t>(std::count(err.begin(), err.end(), '\n')); }

Outcome run(const std::string& arguments) { return run_program(PULLFOCUS_PROGRAM, arguments); }

Outcome run_program(const std::string& program, const std::string& arguments) {
  const TempFolder folder;
  const std::string command =
      fmt::format("'{}' {} >'{}' 2>'{}' </dev/null", program, arguments, folder / "out", folder / "err");
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, exr::test::file_bytes(folder / "out"),
          exr::test::file_bytes(folder / "err")};
}

std::string shared_data(const std::string& name) {
  const std::string path = PULLFOCUS_SOURCE_DIR "/../shared/data/" + name;
  return std::filesystem::exists(path) ? path : "";
}

void write_shot(const TempFolder& folder, int first, int last) {
  const Window window{0, 0, 24, 18};
  for (int frame = first; frame <= last; ++frame) {
    TestImage image(window, window);
    for (const char* name : {"R", "G", "B", "A"}) image.add_constant(name, Imf::HALF, 1);
    image.add_constant("Z", Imf::FLOAT, 1);
    for (int y = 0; y < 18; ++y) {
      for (int x = 0; x < 24; ++x) {
        const bool square = std::abs(x - frame - 4) < 4 && y > 4 && y < 12;
        const auto at = static_cast<std::size_t>(y * 24 + x);
        const auto set_half = [&](const char* name, float value) {
          const Imath::half h(value);
          std::memcpy(&image.channels[name].samples[at * 2], &h, 2);
        };
        set_half("R", square ? 4.f : 0.1f * static_cast<float>(x % 5));
        set_half("G", square ? 0.5f : 0.05f * static_cast<float>(y));
        set_half("B", static_cast<float>((x * 7 + y * 3) % 11) / 11);
        const float z = square ? 2.f : 3.f + 0.2f * static_cast<float>(x);
        std::memcpy(&image.channels["Z"].samples[at * 4], &z, 4);
      }
    }
    Imf::addFocus(image.header, 2);
    Imf::addAperture(image.header, 2);
    image.header.insert("nominalFocalLength", Imf::FloatAttribute(50));
    exr::test::write_scanlines(folder / fmt::format("shot.{:04d}.exr", frame), image);
  }
}

void expect_no_temporaries(const TempFolder& folder) {
  for (const std::string& name : folder.files()) EXPECT_EQ(name.find(".temp."), std::string::npos) << name;
}

testing::AssertionResult same_pixels(const std::string& a, const std::string& b) {
  const TestImage first = exr::test::read_back(a), second = exr::test::read_back(b);
  if (!(first.display == second.display)) return testing::AssertionFailure() << "display windows differ: " << a;
  if (!(first.data == second.data)) return testing::AssertionFailure() << "data windows differ: " << a;
  for (const auto& [name, channel] : first.channels) {
    const auto found = second.channels.find(name);
    if (found == second.channels.end()) return testing::AssertionFailure() << name << " is missing in " << b;
    if (!(found->second == channel))
      return testing::AssertionFailure() << "channel " << name << " of " << a << " differs";
  }
  if (first.channels.size() != second.channels.size()) return testing::AssertionFailure() << "more channels in " << b;
  return testing::AssertionSuccess();
}

}  // namespace pullfocus::test
