#include "exr/file_check.h"

#include <OpenEXR/ImfVersion.h>
#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "image/error.h"

namespace pullfocus::exr {
namespace {

namespace fs = std::filesystem;

constexpr std::uint32_t magic_number = 20000630;
constexpr int max_name_bytes = 255;

class HeaderWalk {
 public:
  HeaderWalk(const std::string& path, std::uint64_t file_bytes)
      : path_(path), file_bytes_(file_bytes), stream_(path, std::ios::binary) {
    if (!stream_) fail(fmt::format("cannot be opened: {}", std::strerror(errno)));
  }

  void run() {
    if (file_bytes_ == 0) fail("the file is empty (0 bytes)");
    if (file_bytes_ < 8 || read_uint32() != magic_number) fail("is not an OpenEXR file");
    const int version = static_cast<int>(read_uint32());
    if (Imf::getVersion(version) != 2 || !Imf::supportsFlags(Imf::getFlags(version))) {
      fail("is of an OpenEXR version that is not supported");
    }
    if (Imf::isNonImage(version)) fail("is a deep image; only flat images are supported");
    int parts = skip_attributes() ? 1 : 0;
    while (Imf::isMultiPart(version) && skip_attributes()) ++parts;
    if (parts != 1) fail(fmt::format("has {} parts; only files of one part are supported", parts));
  }

 private:
  [[noreturn]] void fail(const std::string& reason) const {
    throw Error(ErrorCode::unreadable, fmt::format("{}: {}", path_, reason));
  }

  // One header, up to its closing zero byte; false if it holds no attribute (the end of a multi-part file's
  // headers).
  bool skip_attributes() {
    if (skip_name() == 0) return false;
    do {
      skip_name();
      const std::uint32_t size = read_uint32();
      if (size > file_bytes_) fail("is damaged or cut short: an attribute is larger than the file");
      stream_.ignore(static_cast<std::streamsize>(size));
    } while (skip_name() > 0);
    return true;
  }

  // A zero-terminated string; its length.
  int skip_name() {
    for (int length = 0; length <= max_name_bytes; ++length) {
      const int byte = stream_.get();
      if (byte == std::ifstream::traits_type::eof()) fail("is cut short: its header does not end");
      if (byte == 0) return length;
    }
    fail("is damaged: a name in its header does not end");
  }

  std::uint32_t read_uint32() {
    std::array<unsigned char, 4> bytes{};
    stream_.read(reinterpret_cast<char*>(bytes.data()), bytes.size());
    if (!stream_) fail("is cut short: its header does not end");
    return bytes[0] | bytes[1] << 8 | bytes[2] << 16 | static_cast<std::uint32_t>(bytes[3]) << 24;
  }

  const std::string& path_;
  std::uint64_t file_bytes_;
  std::ifstream stream_;
};

}  // namespace

void check_file(const std::string& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  const auto fail = [&](const std::string& reason) {
    throw Error(ErrorCode::unreadable, fmt::format("{}: {}", path, reason));
  };
  if (status.type() == fs::file_type::not_found) fail("no such file");
  if (fs::is_directory(status)) fail("is a folder, not a file");
  if (!fs::is_regular_file(status)) fail(error ? error.message() : "is not a regular file");
  HeaderWalk(path, fs::file_size(path)).run();
}

std::string plain_reason(std::string_view message, const std::string& path) {
  std::string text(message);
  for (const std::string& noise : {fmt::format("Cannot read image file \"{}\". ", path),
                                   fmt::format("Error reading pixel data from image file \"{}\". ", path),
                                   fmt::format("Cannot open image file \"{}\". ", path)}) {
    for (std::size_t at; (at = text.find(noise)) != std::string::npos;) text.erase(at, noise.size());
  }
  for (char& c : text) {
    if (c == '\n' || c == '\r') c = ' ';
  }
  while (!text.empty() && (text.back() == '.' || text.back() == ' ')) text.pop_back();
  return text;
}

}  // namespace pullfocus::exr
