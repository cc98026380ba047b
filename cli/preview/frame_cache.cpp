#include "preview/frame_cache.h"

#include <algorithm>

#include "image/error.h"

namespace pullfocus::cli::preview {

namespace {

std::size_t bytes_of(const ShotFrame& frame) {
  const std::size_t pixels = frame.frame.window().pixels();
  return pixels * (frame.frame.colour.pixel_bytes() + sizeof(float) * (frame.frame.has_mask() ? 2 : 1));
}

std::size_t distance(std::size_t a, std::size_t b) { return a > b ? a - b : b - a; }

}  // namespace

FrameCache::FrameCache(const Shot& shot, std::size_t most_bytes, std::function<void()> on_read)
    : shot_(shot),
      most_bytes_(most_bytes),
      count_(shot.sequence().frames.size()),
      on_read_(std::move(on_read)),
      thread_([this] { work(); }) {}

void FrameCache::stop() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  asked_.notify_all();
  if (thread_.joinable()) thread_.join();
}

FrameCache::Entry FrameCache::get(std::size_t i) {
  {
    const std::lock_guard lock(mutex_);
    centre_ = i;
    begun_ = true;
  }
  asked_.notify_all();
  return look(i);
}

FrameCache::Entry FrameCache::look(std::size_t i) const {
  const std::lock_guard lock(mutex_);
  const auto found = held_.find(i);
  return found == held_.end() ? Entry{} : found->second.entry;
}

void FrameCache::forget(std::size_t i) {
  {
    const std::lock_guard lock(mutex_);
    const auto found = held_.find(i);
    if (found == held_.end()) return;
    bytes_ -= found->second.bytes;
    held_.erase(found);
  }
  asked_.notify_all();
}

std::vector<bool> FrameCache::loaded() const {
  const std::lock_guard lock(mutex_);
  std::vector<bool> loaded(count_);
  for (const auto& [i, held] : held_) loaded[i] = held.entry.frame != nullptr;
  return loaded;
}

std::size_t FrameCache::bytes() const {
  const std::lock_guard lock(mutex_);
  return bytes_;
}

// The frame asked for, whatever its size; then those ahead, and the one before, as they fit.
std::optional<std::size_t> FrameCache::next() const {
  if (!begun_) return std::nullopt;
  if (!held_.contains(centre_)) return centre_;
  if (frame_bytes_ == 0) return std::nullopt;
  const std::size_t room = std::min(most_bytes_ / frame_bytes_, count_);  // frames
  if (room < 3) return std::nullopt;
  for (std::size_t ahead = 1; ahead + 1 < room; ++ahead) {
    const std::size_t i = (centre_ + ahead) % count_;  // beyond the last comes the first: shots are played in loops
    if (!held_.contains(i)) return i;
  }
  const std::size_t before = (centre_ + count_ - 1) % count_;
  return held_.contains(before) ? std::nullopt : std::optional(before);
}

void FrameCache::make_room(std::size_t bytes) {
  // How soon playing on from the centre gets there; the one just before it counts as near.
  const auto soon = [&](std::size_t i) {
    return (i + 1) % count_ == centre_ ? std::size_t{0}
                                       : std::min(distance(i, centre_), (i + count_ - centre_) % count_);
  };
  while (bytes_ + bytes > most_bytes_) {
    auto farthest = held_.end();
    for (auto it = held_.begin(); it != held_.end(); ++it) {
      if (it->second.bytes == 0 || it->first == centre_) continue;
      if (farthest == held_.end() || soon(it->first) > soon(farthest->first)) farthest = it;
    }
    if (farthest == held_.end()) return;
    bytes_ -= farthest->second.bytes;
    held_.erase(farthest);
  }
}

void FrameCache::work() {
  std::unique_lock lock(mutex_);
  while (true) {
    std::optional<std::size_t> i;
    asked_.wait(lock, [&] { return stop_ || (i = next()); });
    if (stop_) return;
    const exr::SequenceFrame& from = shot_.sequence().frames[*i];
    lock.unlock();
    Held read;
    if (!from.problem.empty()) {
      read.entry.problem = from.problem;
    } else {
      try {
        auto frame = std::make_shared<ShotFrame>();
        shot_.read(from, *frame, false);
        read.bytes = bytes_of(*frame);
        read.entry.frame = std::move(frame);
      } catch (const std::exception& error) {
        read.entry.problem = error.what();
      }
    }
    lock.lock();
    frame_bytes_ = std::max(frame_bytes_, read.bytes);
    make_room(read.bytes);
    bytes_ += read.bytes;
    held_[*i] = std::move(read);
    lock.unlock();
    on_read_();
    lock.lock();
  }
}

}  // namespace pullfocus::cli::preview
