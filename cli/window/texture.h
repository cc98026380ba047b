// A picture in the graphics card's memory.
#pragma once

#include <cstdint>

#include "preview/state.h"

namespace pullfocus::cli::preview {

// Needs a current OpenGL context from its first show() on, until it is destroyed or released.
class Texture {
 public:
  Texture() = default;
  Texture(const Texture&) = delete;
  Texture& operator=(const Texture&) = delete;

  // Sends the picture there, if it is another one than the last. `id`: another number, another picture.
  void show(const Picture& picture, std::uint64_t id);
  // Pixels as squares, for looking at them; or blended.
  void use_squares(bool squares);
  void release();

  unsigned name() const noexcept { return name_; }

 private:
  unsigned name_ = 0;
  std::uint64_t id_ = 0;
  int width_ = 0, height_ = 0;
  bool squares_ = false;
};

}  // namespace pullfocus::cli::preview
