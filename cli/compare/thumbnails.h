// Small pictures for the page, as PNG in base64.
#pragma once

#include <string>
#include <string_view>

#include "compare/results.h"
#include "image/frame.h"

namespace pullfocus::cli {

inline constexpr int kThumbnailWidth = 400;  // pixels at most: whole pixels are averaged in linear light

Picture64 thumbnail(const std::string& caption, const ColourImage& picture, const Window& window);

// FLIP map from black (0) through violet and orange to pale yellow (1). Empty if it is 0 everywhere.
Picture64 error_thumbnail(const std::string& caption, const ColourImage& picture, const ColourImage& reference,
                          const Window& window);

std::string base64(std::string_view bytes);  // RFC 4648, padded

}  // namespace pullfocus::cli
