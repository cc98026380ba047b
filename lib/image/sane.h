// Whether pixels need a sanitiser. SIMD with run-time dispatch; every target gives the same answer.
#pragma once

#include "image/sanitise.h"

namespace pullfocus {

// True only if no sample of n pixels is NaN, infinite or beyond the sanitiser's limit: it would change nothing. May be
// false where the sanitiser lets a pixel pass that has an alpha above a limit below 1.
template <SampleType type>
bool all_sane(const Sanitiser& sanitiser, const Pixel<type>* pixels, int n) noexcept;

}  // namespace pullfocus
