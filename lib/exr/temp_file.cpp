#include "exr/temp_file.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <random>
#include <utility>

#include "exr/file_check.h"
#include "image/error.h"

namespace pullfocus::exr {
namespace {

namespace fs = std::filesystem;

constexpr int attempts = 16;  // at a name that nobody has

std::string random_name(const std::string& final_path) {
  std::random_device random;
  fs::path path(final_path);
  const std::string name =
      fmt::format("{}.{:08x}.temp{}", path.stem().string(), random() & 0xffffffffu, path.extension().string());
  return path.replace_filename(name).string();
}

[[noreturn]] void refuse(const std::string& path, const std::string& reason) {
  throw Error(ErrorCode::unwritable, fmt::format("{}: cannot be written: {}", path, reason));
}

}  // namespace

TempFile::TempFile(const std::string& final_path) : Imf::OStream(final_path.c_str()), final_path_(final_path) {
  std::error_code error;
  const fs::file_status status = fs::status(final_path, error);
  // Renaming would replace even a device.
  if (fs::exists(status) && !fs::is_regular_file(status)) refuse(final_path, "it exists and is not a regular file");
  for (int i = 0; i < attempts && !file_; ++i) {
    temp_path_ = random_name(final_path);
    file_ = std::fopen(temp_path_.c_str(), "wbx");
    if (!file_ && errno != EEXIST) break;
  }
  if (!file_) refuse(final_path, std::strerror(errno));
  exists_ = true;
}

TempFile::~TempFile() {
  if (file_) std::fclose(file_);
  if (exists_) std::remove(temp_path_.c_str());
}

void TempFile::write(const char bytes[], int count) {
  const auto size = static_cast<std::size_t>(count);
  if (std::fwrite(bytes, 1, size, file_) != size) fail(errno);
  position_ += size;
}

void TempFile::seekp(std::uint64_t position) {
  if (fseeko(file_, static_cast<off_t>(position), SEEK_SET) != 0) fail(errno);
  position_ = position;
}

void TempFile::commit() {
  close();
  if (first_error_ != 0) fail(first_error_);
  if (std::rename(temp_path_.c_str(), final_path_.c_str()) != 0) fail(errno);
  exists_ = false;
}

void TempFile::close() {
  std::FILE* file = std::exchange(file_, nullptr);
  if (std::fclose(file) != 0) fail(errno);
}

void TempFile::fail(int error_number) {
  if (first_error_ == 0) first_error_ = error_number;
  refuse(final_path_, std::strerror(first_error_));
}

void write_whole(const std::string& path, const std::function<void(Imf::OStream&)>& write) {
  TempFile stream(path);
  try {
    write(stream);
  } catch (const Error&) {
    throw;
  } catch (const std::exception& error) {
    throw Error(ErrorCode::unwritable,
                fmt::format("{}: cannot be written: {}", path, plain_reason(error.what(), path)));
  }
  stream.commit();
}

}  // namespace pullfocus::exr
