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

// `what()` is one line that names the file, frame, channel or option and says what to do.
class Error : public std::runtime_error {
 public:
  Error(ErrorCode error_code, const std::string& message) : std::runtime_error(message), code_(error_code) {}
  ErrorCode code() const noexcept { return code_; }

 private:
  ErrorCode code_;
};

}  // namespace pullfocus
