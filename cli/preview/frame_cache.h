// Frames of a shot in memory, read in the background.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "shot.h"

namespace pullfocus::cli::preview {

// Reads what get() asks for first, then frames ahead of it, as long as they fit; frames farthest from it leave first.
// All functions may be called from any thread and wait for no file.
class FrameCache {
 public:
  struct Entry {
    std::shared_ptr<const ShotFrame> frame;  // null: not there (yet)
    std::string problem;                     // why it cannot be read; empty: it is on its way
  };

  // `shot` must live as long. `on_read` is called from the reading thread whenever a frame has been read or given up.
  FrameCache(const Shot& shot, std::size_t most_bytes, std::function<void()> on_read);
  ~FrameCache() { stop(); }

  // Reads no further file, and waits for the one being read: `on_read` is not called any more.
  void stop();

  // Position `i` in the shot's sequence becomes the one that is read first and read ahead from.
  Entry get(std::size_t i);
  // The same, but asks for nothing.
  Entry look(std::size_t i) const;

  // Forgets frame i, so that its file is read again.
  void forget(std::size_t i);

  std::vector<bool> loaded() const;
  std::size_t bytes() const;  // of the frames held

 private:
  void work();
  std::optional<std::size_t> next() const;  // with the lock held
  void make_room(std::size_t bytes);        // with the lock held

  struct Held {
    Entry entry;
    std::size_t bytes = 0;
  };

  const Shot& shot_;
  const std::size_t most_bytes_, count_;
  const std::function<void()> on_read_;
  mutable std::mutex mutex_;
  std::condition_variable asked_;
  std::map<std::size_t, Held> held_;
  std::size_t bytes_ = 0, frame_bytes_ = 0;  // frame_bytes_: of the largest so far
  std::size_t centre_ = 0;
  bool stop_ = false, begun_ = false;
  std::thread thread_;
};

}  // namespace pullfocus::cli::preview
