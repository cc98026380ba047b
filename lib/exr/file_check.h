// A first look at a file, before OpenEXR allocates what the file asks for.
#pragma once

#include <string>
#include <string_view>

namespace pullfocus::exr {

// Throws Error(unreadable) with one clear line unless `path` is a regular file that starts as an OpenEXR file
// with a single flat part, and whose header's attributes lie inside the file. A damaged size field would
// otherwise make the library allocate up to 2 GB per attribute.
void check_file(const std::string& path);

// OpenEXR's words for an error, in one line and without the path it repeats.
std::string plain_reason(std::string_view message, const std::string& path);

}  // namespace pullfocus::exr
