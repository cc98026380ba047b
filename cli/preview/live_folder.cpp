// Of a session: frames that appear while it runs, as a renderer writes them.
#include <fmt/format.h>

#include <algorithm>

#include "exr/range.h"
#include "image/error.h"
#include "preview/live_session.h"

namespace pullfocus::cli::preview {

void LiveSession::look_for_files(double seconds) {
  take_over_new_shot();
  if (!live_ || seconds - looked_at_ < 1 || jobs_.waiting() > 0) return;
  looked_at_ = seconds;
  jobs_.add([this, shot = open_->kept, times = open_->times] { look_at_folder(shot->sequence().pattern, times); });
}

// What has changed must be so for two looks in a row: a file may just be being written.
void LiveSession::look_at_folder(const exr::Pattern& pattern, const FileTimes& opened) {
  const FileTimes now = file_times(pattern);
  const bool is_calm = now == seen_;
  seen_ = now;
  if (!is_calm || now == opened || now.empty()) return;
  try {
    auto shot = std::make_unique<OpenShot>(arguments_.input, arguments_.camera,
                                           static_cast<std::size_t>(arguments_.cache_mb * 1e6), [this] { changed(); });
    const std::lock_guard lock(mutex_);
    new_shot_ = std::move(shot);
  } catch (const Error& error) {
    say(error.what(), true);
  }
  changed();
}

// Between two pictures: not while anything of the old one is to be written. The choice of camera, keys and kernel
// stays, and the frame, if it is still there.
void LiveSession::take_over_new_shot() {
  if (waiting_to_be_written() > 0) return;
  {
    const std::lock_guard lock(mutex_);
    if (!new_shot_) return;
    std::swap(open_, new_shot_);
  }
  const int frame = new_shot_->shot.sequence().frames[frame_].frame;
  const std::vector<int> before = new_shot_->shot.frame_numbers(), now = open_->shot.frame_numbers();
  std::vector<int> added;
  for (const int number : now) {
    if (std::find(before.begin(), before.end(), number) == before.end()) added.push_back(number);
  }
  const auto place = std::find(now.begin(), now.end(), frame);
  frame_ = place == now.end() ? std::min(frame_, now.size() - 1) : static_cast<std::size_t>(place - now.begin());
  {
    std::unique_ptr<OpenShot> old;
    const std::lock_guard lock(mutex_);
    std::swap(old, new_shot_);
    jobs_.add([gone = std::shared_ptr<OpenShot>(std::move(old))] {});  // it may have to wait for a file
  }
  play_start_.reset();
  setup_ = make_setup(choice_);
  say(added.empty() ? "files have changed: the shot was read again"
                    : fmt::format("new frames: {}", exr::format_frames(added)));
  wish();
}

}  // namespace pullfocus::cli::preview
