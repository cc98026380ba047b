// pullfocus: depth of field for rendered image sequences, recomputing only what changed.
//
// The whole story, in the order the data flows:
//
//   image/       Window, ColourImage, Plane; Frame = RGBA colour + depth + holdout mask over one window
//   camera/      ThinLens and a depth kind give a CocFunction: depth -> signed circle of confusion in pixels;
//                KeyedValue: focus, f-number and focal length over frames; repair_depth()
//   importance/  what changed against the committed state, how noticeable it is, which of it a budget affords
//   scatter/     KernelShape; kernels as run edges; sources into destination bands
//   resolve/     sums of weighted colour divided by sums of weight; layers laid front to back
//   filter/      LinearFilter and IncrementalFilter behind one interface; Stats, LeftOver; the Plan; explain()
//   metrics/     how far two pictures are apart: RMSE, PSNR, relative MSE, SSIM, FLIP
//
// Files are none of the core's business: exr/ (a library of its own) reads and writes sequences.
//
//   KernelOptions, FilterOptions   what to do; plain structs, validated by name
//   auto filter = pullfocus::make_incremental_filter(window, options);
//   for each frame:
//     const Stats& stats = filter->filter(frame, coc_function(lens, raster, DepthKind::planar));
//     use(filter->result(), filter->result_window());
//
// What holds everywhere:
//   colours    premultiplied, scene-linear R,G,B,A; half or float32
//   distances  scene units; lens measures in millimetres; CoC diameters in pixels, positive behind focus
//   exactness  with nothing left over, the incremental result is the linear one bit for bit, for any history, number of
//              threads, SIMD target, and wherever a shot is cut
//   threads    a call uses FilterOptions::threads threads of oneTBB; one call at a time on one filter
//   errors     pullfocus::Error, which names what is wrong and what to do; a frame is refused before anything changes
//   memory     about 44 bytes a pixel and the frames for opaque half input, a few more with layers; make_plan() tells
#pragma once

#include "camera/depth.h"
#include "camera/depth_repair.h"
#include "camera/keys.h"
#include "camera/thin_lens.h"
#include "filter/explain.h"
#include "filter/filter.h"
#include "filter/left_over.h"
#include "filter/options.h"
#include "filter/plan.h"
#include "filter/stats.h"
#include "image/error.h"
#include "image/frame.h"
#include "image/window.h"
#include "metrics/metrics.h"
