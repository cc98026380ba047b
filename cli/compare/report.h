// The comparison as text: the same numbers in every form.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "compare/results.h"

namespace pullfocus::cli {

// Aligned, for the terminal; ends in a line feed.
std::string table(const ShotResult& shot);

// One object; times in milliseconds, shares in 0..1, PSNR without error null; every frame of every filter.
std::string json_report(const std::vector<ShotResult>& shots);

// Sections of a Markdown document (GitHub's tables), one a shot, headings of the third level.
std::string markdown_report(const std::vector<ShotResult>& shots);

// A line of names, then one line a filter and shot (RFC 4180); PSNR without error is inf, what was not measured empty.
std::string csv_report(const std::vector<ShotResult>& shots);

// One page that needs nothing else: styles, plots and pictures are in it. Well-formed XML.
std::string html_report(const std::vector<ShotResult>& shots);

// `value` for tables and the page: 4 significant digits, decibels and SSIM with fixed places.
std::string shown(const Measure& measure, double value);
std::string shown_ms(double ms);

// "against linear (same kernel, visibility and CoC step)", ...
std::string heading(const ShotResult& shot, Against against);

// Times and counts in the order of kTimeTitles; "-": there are none.
inline constexpr std::array kTimeTitles{"first ms", "median ms", "speed-up", "updated %"};
std::vector<std::string> time_texts(const ShotResult& shot, const Row& row);

// Of --measure-every: empty, or which frames the errors are of.
std::string measured_frames_text(const ShotResult& shot);

// Frames of the shot: "1-24".
std::string frames_of(const ShotResult& shot);

// Replaces the file in one go. Throws Error(unwritable) naming the option and the file.
void write_report(const std::string& option, const std::string& path, const std::string& text);

// Throws Error(unwritable) now rather than after the work: a report could not be written there.
void check_report_path(const std::string& option, const std::string& path);

}  // namespace pullfocus::cli
