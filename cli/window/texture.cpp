#include "window/texture.h"

#include <GL/gl.h>
#include <GL/glext.h>

namespace pullfocus::cli::preview {

void Texture::show(const std::shared_ptr<const Picture>& picture) {
  if (name_ != 0 && picture == picture_) return;
  if (name_ == 0) {
    glGenTextures(1, &name_);
    glBindTexture(GL_TEXTURE_2D, name_);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  }
  glBindTexture(GL_TEXTURE_2D, name_);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  if (picture->width == width_ && picture->height == height_) {
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE, picture->rgba.data());
  } else {
    width_ = picture->width;
    height_ = picture->height;
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, width_, height_, 0, GL_RGBA, GL_UNSIGNED_BYTE, picture->rgba.data());
  }
  picture_ = picture;
}

void Texture::use_squares(bool squares) {
  if (name_ == 0 || squares == squares_) return;
  squares_ = squares;
  glBindTexture(GL_TEXTURE_2D, name_);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, squares ? GL_NEAREST : GL_LINEAR);
}

void Texture::release() {
  if (name_ != 0) glDeleteTextures(1, &name_);
  name_ = 0;
  picture_.reset();
}

}  // namespace pullfocus::cli::preview
