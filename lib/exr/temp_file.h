// The file that a result grows in before it gets its final name.
#pragma once

#include <OpenEXR/ImfIO.h>

#include <cstdint>
#include <cstdio>
#include <functional>
#include <string>

namespace pullfocus::exr {

// OpenEXR's own stream closes in a destructor that swallows errors, so a full disk could go unseen; this one
// does not.
class TempFile : public Imf::OStream {
 public:
  // Creates `name.XXXXXXXX.temp.ext` beside `final_path` (`name.ext`), X random. Throws Error(unwritable), as
  // all do.
  explicit TempFile(const std::string& final_path);
  ~TempFile() override;  // removes the file unless committed
  TempFile(const TempFile&) = delete;
  TempFile& operator=(const TempFile&) = delete;

  void write(const char bytes[], int count) override;
  std::uint64_t tellp() override { return position_; }
  void seekp(std::uint64_t position) override;

  // Closes the file and gives it its final name, replacing an older file.
  void commit();

 private:
  [[noreturn]] void fail(int error_number);
  void close();

  std::string final_path_, temp_path_;
  std::FILE* file_ = nullptr;
  std::uint64_t position_ = 0;
  int first_error_ = 0;  // kept, because OpenEXR drops what is thrown while it closes
  bool exists_ = false;
};

// Writes a file that is there whole or not at all: `write` fills the stream. What it throws beside Error is reported as
// Error(unwritable) that names the file.
void write_whole(const std::string& path, const std::function<void(Imf::OStream&)>& write);

}  // namespace pullfocus::exr
