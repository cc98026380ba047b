#include "preview/engine.h"

#include <algorithm>

#include "image/error.h"

namespace pullfocus::cli::preview {

Engine::Engine(const Shot& shot, FrameCache& cache, std::function<void()> on_shown)
    : shot_(shot), cache_(cache), on_shown_(std::move(on_shown)), shown_(std::make_shared<Shown>()) {
  thread_ = std::thread([this] { work(); });
}

Engine::~Engine() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  wake_.notify_all();
  thread_.join();
}

void Engine::want(Wish wish) {
  {
    const std::lock_guard lock(mutex_);
    wanted_ = std::move(wish);
    settled_ = false;
  }
  wake_.notify_all();
}

void Engine::on_read() {
  {
    const std::lock_guard lock(mutex_);
    poked_ = true;
  }
  wake_.notify_all();
  on_shown_();
}

std::shared_ptr<const Shown> Engine::shown() const {
  const std::lock_guard lock(mutex_);
  return shown_;
}

void Engine::finish(Wish wish, Take take) {
  {
    const std::lock_guard lock(mutex_);
    orders_.push_back({std::move(wish), std::move(take)});
  }
  wake_.notify_all();
}

bool Engine::is_settled() const {
  const std::lock_guard lock(mutex_);
  return settled_ && orders_.empty();
}

bool Engine::is_ordered() const {
  const std::lock_guard lock(mutex_);
  return !orders_.empty();
}

bool Engine::is_newer_wanted(std::uint64_t id) const {
  const std::lock_guard lock(mutex_);
  return stop_ || wanted_.id > id;
}

void Engine::work() {
  Next next = Next::nothing;
  std::uint64_t seen = 0;  // the last wish looked at
  bool at_order = false;   // `next` is of the first order, not of the last wish
  while (true) {
    Wish wish;
    Take take;
    {
      std::unique_lock lock(mutex_);
      wake_.wait(lock, [&] {
        if (stop_ || poked_) return true;
        if (!orders_.empty()) return !at_order || next != Next::file;
        return next == Next::more || wanted_.id != seen;
      });
      if (stop_) return;
      poked_ = false;
      at_order = !orders_.empty();
      if (at_order) {
        wish = orders_.front().wish;
        take = orders_.front().take;
      } else {
        wish = wanted_;
        seen = wish.id;
      }
    }
    if (wish.id == 0) continue;
    next = step(wish, at_order);
    const bool delivered = at_order && next == Next::nothing;
    if (delivered) {
      deliver(take);
      at_order = false;
      seen = 0;  // back to what was wanted
    }
    const std::lock_guard lock(mutex_);
    if (delivered) orders_.pop_front();
    settled_ = !at_order && next == Next::nothing && wanted_.id == seen;
  }
}

void Engine::deliver(const Take& take) {
  if (!complete_ || !has_result_ || !now_.problem.empty()) return take(nullptr, now_.problem);
  const Exact exact{filter_->result(), filter_->result_window()};
  take(&exact, "");
}

Engine::Next Engine::step(const Wish& wish, bool to_the_end) {
  const FrameCache::Entry entry = cache_.get(wish.frame);
  if (!entry.frame && entry.problem.empty()) return Next::file;  // on_read() will tell
  now_.request = wish.id;
  now_.frame = wish.frame;
  now_.problem.clear();
  try {
    if (!entry.problem.empty()) throw Error(ErrorCode::unreadable, entry.problem);
    if (frame_ != entry.frame) {
      frame_ = entry.frame;
      has_result_ = complete_ = full_is_valid_ = picture_is_valid_ = false;
      if (wish.camera->depth_kind() == DepthKind::planar) {
        const DepthRange range = depth_range(frame_->frame);
        now_.depth_near = range.near;
        now_.depth_far = range.far;
      }
    }
    const CocFunction coc = wish.camera->coc(shot_.sequence().frames[wish.frame].frame, frame_->file);
    if (setup_ != wish.setup) {
      filter_.reset();  // their memory first
      linear_.reset();
      filter_ = make_incremental_filter(shot_.state_window(), wish.setup->options);
      setup_ = wish.setup;
      has_result_ = complete_ = false;
    }
    if (!has_result_ || !(coc == coc_)) {
      coc_ = coc;
      has_result_ = full_is_valid_ = picture_is_valid_ = false;
      refinement_.begin(*filter_, frame_->frame, coc_, wish.budget);
      has_result_ = true;
    } else if (!complete_ && (wish.refine || to_the_end)) {
      refinement_.go_on(*filter_, wish.budget, wish.hurried && !to_the_end,
                        [&] { return !to_the_end && is_newer_wanted(wish.id); });
      const View view = wish.look.view;
      picture_is_valid_ &= view == View::input || view == View::depth || view == View::coc;
    }
    complete_ = refinement_.is_exact();
    show(wish);
  } catch (const std::exception& error) {
    now_.problem = error.what();
    now_.exact = false;
    now_.left = {};
    if (entry.frame && !has_result_) {
      show(wish);
    } else {
      publish(now_);
    }
    return Next::nothing;
  }
  return !complete_ && (wish.refine || to_the_end) ? Next::more : Next::nothing;
}

void Engine::make_full(const Wish& wish) {
  if (full_is_valid_ || complete_) return;
  if (!linear_) linear_ = make_linear_filter(shot_.state_window(), wish.setup->options);
  linear_->filter(frame_->frame, coc_);
  full_is_valid_ = true;
}

void Engine::show(const Wish& wish) {
  const Look& look = wish.look;
  const Frame& frame = frame_->frame;
  if (has_result_) {
    now_.exact = complete_;
    now_.calls = refinement_.calls();
    now_.first_ms = refinement_.first_ms();
    now_.total_ms = refinement_.total_ms();
    now_.left = complete_ ? LeftOver{} : filter_->left_over();
  }
  if (tone_.exposure() != look.exposure || tone_.srgb() != look.srgb) tone_ = ToneTable(look.exposure, look.srgb);
  if (!picture_is_valid_ || !(look == looked_)) {
    auto picture = std::make_shared<Picture>();
    if (look.view == View::depth) {
      show_depth(frame, wish.camera->depth_kind(), *picture);
    } else if (look.view == View::coc) {
      show_coc(frame, has_result_ ? &coc_ : nullptr, 40, *picture);
    } else if (look.view == View::input || !has_result_) {
      show_colour(frame.colour, tone_, *picture);
    } else if (look.view == View::importance) {
      Plane importance;
      filter_->left_over_importance(importance);
      show_importance(importance, *picture);
    } else if (look.view == View::difference) {
      make_full(wish);
      show_difference(filter_->result(), complete_ ? filter_->result() : linear_->result(), tone_, *picture);
    } else {
      show_colour(filter_->result(), tone_, *picture);
    }
    if (look.wipe) {
      const float end = std::clamp(*look.wipe, 0.f, 1.f) * static_cast<float>(picture->width);
      show_colour_left_of(static_cast<int>(end + 0.5f), frame.colour, tone_, *picture);
    }
    looked_ = look;
    picture_is_valid_ = true;
    now_.picture = std::move(picture);
    ++now_.picture_id;
  }
  publish(now_);
}

void Engine::publish(Shown shown) {
  {
    const std::lock_guard lock(mutex_);
    shown_ = std::make_shared<Shown>(std::move(shown));
  }
  on_shown_();
}

}  // namespace pullfocus::cli::preview
