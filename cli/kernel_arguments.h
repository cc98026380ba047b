// The kernel as typed: --kernel, --blade-rotation, --blade-roundness.
#pragma once

#include <string>

#include "scatter/kernel_shape.h"

namespace pullfocus::cli {

struct KernelArguments {
  std::string kernel = "disc";
  double blade_rotation = KernelShape{}.blade_rotation_deg, blade_roundness = KernelShape{}.blade_roundness;
  bool operator==(const KernelArguments&) const = default;
};

// "image:FILE" is read (Rec. 709 luminance of its linear, premultiplied colours). Throws Error(usage).
KernelShape kernel_shape(const KernelArguments& arguments);

}  // namespace pullfocus::cli
