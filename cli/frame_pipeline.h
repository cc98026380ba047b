// Frames through three stages that overlap: while one is filtered, later ones are read and earlier ones written.
#pragma once

#include <cstddef>
#include <exception>

namespace pullfocus::cli {

// What is done to each of `count` frames. Every stage takes the frames in order, one at a time; different stages run at
// the same time, on different threads. `slot` (< in_flight) is the frame's own from the beginning of its read() to the
// end of its write() or failed(): a place for buffers that later frames use again.
class FrameStages {
 public:
  virtual ~FrameStages() = default;
  virtual void read(std::size_t frame, std::size_t slot) = 0;
  virtual void filter(std::size_t frame, std::size_t slot) = 0;
  virtual void write(std::size_t frame, std::size_t slot) = 0;

  // For a frame of which a stage threw, in place of its further stages; in order with the calls of write(). False: the
  // frame is the last; nothing more is called for later ones, though some may have been read and filtered already.
  virtual bool failed(std::size_t frame, std::exception_ptr error) = 0;
};

// At most `in_flight` (>= 1) frames are between the beginning of read() and the end of write() at any time; 1: all in
// the calling thread. Returns the largest number there was.
std::size_t run_frames(std::size_t count, std::size_t in_flight, FrameStages& stages);

}  // namespace pullfocus::cli
