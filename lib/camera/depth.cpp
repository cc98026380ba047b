#include "camera/depth.h"

#include "camera/names.h"

namespace pullfocus {
namespace {

constexpr Named<DepthKind> kinds[] = {{DepthKind::planar, "planar"}, {DepthKind::coc, "coc"}};

}  // namespace

std::string_view name(DepthKind kind) noexcept { return name_in(kinds, kind); }

DepthKind parse_depth_kind(std::string_view text) { return parse_name(kinds, text, "--depth-kind"); }

}  // namespace pullfocus
