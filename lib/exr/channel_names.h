// Parts of channel names: `Layer.Sublayer.R` is channel `R` of layer `Layer.Sublayer`, whose parent is
// `Layer`.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace pullfocus::exr {

// What precedes the last dot; empty for the root layer.
std::string_view layer_of(std::string_view channel) noexcept;

// What follows the last dot.
std::string_view base_of(std::string_view name) noexcept;

// `layer` and `base` with a dot between them, or `base` alone for the root layer.
std::string join_name(std::string_view layer, std::string_view base);

// True if the last components of `layer` are `ending`: `A.B.C` ends in `C` and in `B.C`, not in `.C` or `B`.
bool ends_in(std::string_view layer, std::string_view ending) noexcept;

// ASCII letters made small.
std::string lower(std::string_view text);

// `A, B, C`, for messages; cut after 40 names.
std::string list_names(const std::vector<std::string>& names);

}  // namespace pullfocus::exr
