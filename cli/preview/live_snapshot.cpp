// Of a session: what it shows of itself.
#include <unistd.h>

#include <fstream>

#include "image/error.h"
#include "preview/command_text.h"
#include "preview/live_session.h"

namespace pullfocus::cli::preview {

namespace {

std::size_t memory_of_process() {
  std::ifstream file("/proc/self/statm");
  std::size_t all = 0, resident = 0;
  file >> all >> resident;
  return resident * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

}  // namespace

Snapshot LiveSession::snapshot() {
  Snapshot s;
  s.shown = open_->engine.shown();
  s.request = request_;
  s.frames = open_->shot.frame_numbers();
  s.loaded = open_->cache.loaded();
  s.frame = frame_;
  const FrameCache::Entry entry = open_->cache.look(frame_);
  s.loading = !entry.frame && entry.problem.empty();
  const Window& window = open_->shot.state_window();
  s.window_x0 = window.x0;
  s.window_y0 = window.y0;
  s.width = window.width();
  s.height = window.height();
  s.pixel_aspect = static_cast<double>(open_->shot.sequence().first.pixel_aspect);

  s.keys = choice_.keys;
  s.has_lens = camera_.depth_kind() != DepthKind::coc;
  s.focus = setting_now("focus");
  s.fstop = setting_now("fstop");
  s.focal_length = setting_now("focal-length");
  s.kernel = choice_.kernel.kernel;
  s.visibility = choice_.visibility;
  s.budget = budget_text_;
  s.refine = refine_;
  s.look = look_;
  s.playing = playing_;
  s.loop = loop_;
  s.live = live_;
  s.fps = fps_;
  s.dropped = dropped_;
  s.unsaved = !(choice_.keys == saved_);
  s.can_undo = !undo_.empty();
  s.can_redo = !redo_.empty();
  s.keys_file = keys_file_;
  s.command_line = shell_line(filter_arguments(arguments_.input, arguments_.camera, choice_.keys, filter_of(choice_),
                                               arguments_.out.empty() ? "OUT/" : arguments_.out));
  if (shot_run_ && !shot_run_->is_over()) s.job = shot_run_->share_done();
  s.writing = waiting_to_be_written();
  s.memory_bytes = memory_of_process();
  s.title = open_->shot.sequence().pattern.text();
  const std::lock_guard lock(mutex_);
  s.message = message_;
  s.message_is_error = message_is_error_;
  return s;
}

Probe LiveSession::probe(int x, int y) {
  Probe probe;
  const std::shared_ptr<const Shown> shown = open_->engine.shown();
  const std::shared_ptr<const ShotFrame> frame = open_->cache.look(shown->frame).frame;
  const Window& w = open_->shot.state_window();
  x += w.x0;
  y += w.y0;
  if (!frame || !w.contains(x, y)) return probe;
  probe.inside = true;
  probe.depth = frame->frame.depth.at(x, y);
  probe.background = is_background(camera_.depth_kind(), probe.depth);
  for (int c = 0; c < 4; ++c) probe.colour[c] = frame->frame.colour.get(x, y, c);
  try {
    const CocFunction coc = camera_.coc(open_->shot.sequence().frames[shown->frame].frame, frame->file);
    probe.coc = probe.background ? coc.background() : coc(probe.depth);
    probe.has_coc = true;
  } catch (const Error&) {  // the camera is not complete
  }
  return probe;
}

}  // namespace pullfocus::cli::preview
