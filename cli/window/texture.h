// A picture in the graphics card's memory.
#pragma once

#include <memory>

#include "preview/state.h"

namespace pullfocus::cli::preview {

// Needs a current OpenGL context from its first show() on, until it is destroyed or released.
class Texture {
 public:
  Texture() = default;
  Texture(const Texture&) = delete;
  Texture& operator=(const Texture&) = delete;

  // Sends the picture there, if it is another one than the last.
  void show(const std::shared_ptr<const Picture>& picture);
  // Pixels as squares, for looking at them; or blended.
  void use_squares(bool squares);
  void release();

  unsigned name() const noexcept { return name_; }

 private:
  unsigned name_ = 0;
  std::shared_ptr<const Picture> picture_;
  int width_ = 0, height_ = 0;
  bool squares_ = false;
};

}  // namespace pullfocus::cli::preview
