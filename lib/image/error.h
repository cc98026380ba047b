// The one error type at every API boundary.
#pragma once

#include <stdexcept>
#include <string>

namespace pullfocus {

enum class ErrorCode {
  usage,       // an option or argument is wrong or missing: nothing was done
  unreadable,  // a file is missing, truncated, corrupt, or not what was asked for
  unwritable,  // a result could not be stored
  content      // a frame's pixels are not acceptable (only with strict checking)
};

// `what()` is one line that names the file, frame, channel or option and says what to do. Control characters in the
// message, which names in damaged files may bring along, become question marks.
class Error : public std::runtime_error {
 public:
  Error(ErrorCode error_code, const std::string& message) : std::runtime_error(one_line(message)), code_(error_code) {}
  ErrorCode code() const noexcept { return code_; }

 private:
  static std::string one_line(std::string text) {
    for (char& c : text) {
      if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
    }
    return text;
  }

  ErrorCode code_;
};

}  // namespace pullfocus
