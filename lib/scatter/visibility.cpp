#include "scatter/visibility.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <charconv>
#include <cmath>

#include "image/error.h"
#include "scatter/layers.h"

namespace pullfocus {

namespace {

[[noreturn]] void refuse(std::string_view text) {
  throw Error(
      ErrorCode::usage,
      fmt::format("--visibility '{}' is not known: use auto, none, layers, layers:BORDERS with CoC diameters in "
                  "pixels such as layers:-2,2, bitmap, or bitmap:L such as bitmap:32",
                  text));
}

std::vector<double> parse_borders(std::string_view list, std::string_view text) {
  std::vector<double> borders;
  const char* at = list.data();
  const char* const end = at + list.size();
  while (true) {
    const auto parsed = std::from_chars(at, end, borders.emplace_back());
    if (parsed.ec != std::errc{}) refuse(text);
    at = parsed.ptr;
    if (at == end) return borders;
    if (*at++ != ',') refuse(text);
  }
}

int parse_size(std::string_view size, std::string_view text) {
  int value = 0;
  const char* const end = size.data() + size.size();
  const auto parsed = std::from_chars(size.data(), end, value);
  if (parsed.ec != std::errc{} || parsed.ptr != end) refuse(text);
  return value;
}

}  // namespace

VisibilityOptions parse_visibility(std::string_view text) {
  constexpr std::string_view layers = "layers:", bitmap = "bitmap:";
  VisibilityOptions options;
  if (text == "auto" || text == "layers") return options;
  if (text == "none") {
    options.kind = VisibilityOptions::Kind::none;
  } else if (text.starts_with(layers)) {
    options.borders = parse_borders(text.substr(layers.size()), text);
  } else if (text == "bitmap" || text.starts_with(bitmap)) {
    options.kind = VisibilityOptions::Kind::bitmap;
    if (text != "bitmap") options.bitmap_size = parse_size(text.substr(bitmap.size()), text);
  } else {
    refuse(text);
  }
  validate(options);
  return options;
}

void validate(const VisibilityOptions& options) {
  if (options.kind == VisibilityOptions::Kind::layers) validate_borders(options.borders);
  const int size = options.bitmap_size;
  if (size < 2 || size > 64 || size % 2 != 0) {
    throw Error(ErrorCode::usage,
                fmt::format("--visibility bitmap:{}: the size must be an even number from 2 to 64", size));
  }
  if (!(options.cutoff_px >= 0 && std::isfinite(options.cutoff_px))) {
    throw Error(ErrorCode::usage, "--cutoff must be a finite number of pixels of at least 0");
  }
}

std::string describe(const VisibilityOptions& options) {
  switch (options.kind) {
    case VisibilityOptions::Kind::none:
      return "none";
    case VisibilityOptions::Kind::layers:
      return fmt::format("layers split at {} px", fmt::join(options.borders, ", "));
    case VisibilityOptions::Kind::bitmap:
      break;
  }
  return fmt::format("bitmap:{}, cut-off {:g} px", options.bitmap_size, options.cutoff_px);
}

std::span<const double> layer_borders(const VisibilityOptions& options) noexcept {
  if (options.kind != VisibilityOptions::Kind::layers) return {};
  return options.borders;
}

}  // namespace pullfocus
