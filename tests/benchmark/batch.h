// What filtering adds to a batch run that reads and writes EXR files.
#pragma once

namespace pullfocus::test {

// Makes shots of half RGB and float Z, ZIP, in a temporary folder, runs the pipeline of `pullfocus filter` over them
// with and without the filter in turn, and prints a Markdown table of medians of ratios. `quick`: small and once.
// `threads`: 0 for one a processor. Throws Error.
void measure_batch(bool quick, int threads);

}  // namespace pullfocus::test
