#include "preview/live_session.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <thread>
#include <utility>

#include "image/error.h"

namespace pullfocus::cli::preview {

namespace {

// Beside nothing else, "shot.keys.toml" in the current folder for "somewhere/shot.####.exr".
std::string usual_keys_file(const std::string& input) {
  std::string name = std::filesystem::path(input).filename().string();
  name = name.substr(0, name.find_first_of("#@%"));
  if (name.ends_with(".exr") || name.ends_with(".EXR")) name.resize(name.size() - 4);
  while (!name.empty() && std::string("._-").find(name.back()) != std::string::npos) name.pop_back();
  return (name.empty() ? "shot" : name) + ".keys.toml";
}

}  // namespace

LiveSession::LiveSession(const PreviewArguments& arguments)
    : arguments_(arguments),
      camera_(arguments.camera),
      budget_text_(arguments.budget),
      keys_file_(arguments.keys),
      budget_(Budget::parse(arguments.budget)),
      live_(arguments.live),
      open_(std::make_unique<OpenShot>(arguments.input, arguments.camera,
                                       static_cast<std::size_t>(arguments.cache_mb * 1e6), [this] { changed(); })) {
  camera_ = open_->shot.camera();
  choice_ = {camera_.keys(), arguments.filter.kernel, arguments.filter.visibility};
  saved_ = choice_.keys;
  seen_ = open_->times;
  setup_ = make_setup(choice_);
  const std::optional<std::string>& focus = arguments.camera.focus;
  if (keys_file_.empty() && focus && focus->starts_with('@')) keys_file_ = focus->substr(1);
  if (keys_file_.empty()) keys_file_ = usual_keys_file(arguments.input.input);
  if (!arguments.record.empty()) {
    record_.open(arguments.record);
    if (!record_) throw Error(ErrorCode::unwritable, "--record " + arguments.record + ": cannot be written");
  }
  for (const auto& frame : open_->shot.sequence().frames) {
    if (!frame.problem.empty()) say(frame.problem, true);
  }
  autosaved_ = saved_;
  if (arguments.autosave && std::filesystem::exists(autosave_file(keys_file_))) {
    say("an earlier session ended without saving its keys: load them from " + autosave_file(keys_file_));
  }
  failures_ = 0;  // of what is done from now on
  wish();
}

// What is to be exported is still made exact and written; then nothing is read any more, and what is being filtered
// ends.
LiveSession::~LiveSession() {
  on_change({});
  while (open_->engine.is_ordered()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  std::error_code ignored;
  if (!(autosaved_ == saved_)) std::filesystem::remove(autosave_file(keys_file_), ignored);
}

FilterArguments LiveSession::filter_of(const Choice& choice) const {
  FilterArguments filter = arguments_.filter;
  filter.kernel = choice.kernel;
  filter.visibility = choice.visibility;
  return filter;
}

std::shared_ptr<const FilterSetup> LiveSession::make_setup(const Choice& choice) const {
  const exr::FileInfo& first = open_->shot.sequence().first;
  auto setup = std::make_shared<FilterSetup>();
  setup->options =
      filter_options(filter_of(choice), {static_cast<double>(first.pixel_aspect), first.chromaticities, {}});
  setup->options.slice_edges = std::int64_t{1} << 24;  // pictures are shown by time, and larger slices scatter faster
  setup->method = describe_method("incremental", setup->options);
  return setup;
}

Wish LiveSession::make_wish(bool hurried) {
  auto camera = std::make_shared<Camera>(camera_);
  return {++request_, frame_, std::move(camera), setup_, budget_, refine_, hurried, look_};
}

void LiveSession::wish() { open_->engine.want(make_wish(holding_ || playing_)); }

void LiveSession::changed() const {
  const std::lock_guard lock(waking_);
  if (wake_) wake_();
}

void LiveSession::on_change(std::function<void()> wake) {
  const std::lock_guard lock(waking_);
  wake_ = std::move(wake);
}

void LiveSession::say(std::string message, bool is_error) {
  {
    const std::lock_guard lock(mutex_);
    messages_.push_back((is_error ? "error: " : "") + message);
    if (messages_.size() > 1000) messages_.erase(messages_.begin());  // a window takes none
    message_ = std::move(message);
    message_is_error_ = is_error;
    failures_ += is_error;
  }
  changed();
}

std::vector<std::string> LiveSession::take_messages() {
  const std::lock_guard lock(mutex_);
  return std::exchange(messages_, {});
}

int LiveSession::failures() const {
  const std::lock_guard lock(mutex_);
  return failures_;
}

bool LiveSession::is_settled() const { return open_->engine.is_settled(); }

// Asked of the engine first: what it delivers meanwhile is a job before it is an order no more.
int LiveSession::waiting_to_be_written() const {
  const int ordered = open_->engine.is_ordered() ? 1 : 0;
  return ordered + jobs_.waiting();
}

bool LiveSession::is_writing() const { return waiting_to_be_written() > 0 || (shot_run_ && !shot_run_->is_over()); }

void LiveSession::use(const Choice& choice) {
  if (choice.kernel != choice_.kernel || choice.visibility != choice_.visibility) setup_ = make_setup(choice);
  choice_ = choice;
  camera_.set_keys(choice_.keys);
  wish();
}

void LiveSession::choose(Choice choice) {
  if (choice == choice_) return;
  const Choice before = choice_;
  use(choice);
  if (!holding_ || !held_) undo_.push_back(before);
  held_ = holding_;
  redo_.clear();
}

void LiveSession::undo(std::vector<Choice>& from, std::vector<Choice>& to) {
  if (from.empty()) return say("there is nothing to take back");
  to.push_back(choice_);
  const Choice choice = std::move(from.back());
  from.pop_back();
  use(choice);
}

void LiveSession::go_to(std::size_t frame) {
  if (frame == frame_) return;
  frame_ = frame;
  wish();
}

std::size_t LiveSession::position_of(const std::string& text) const {
  const auto& frames = open_->shot.sequence().frames;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (std::to_string(frames[i].frame) == text) return i;
  }
  throw Error(ErrorCode::usage, fmt::format("frame {} is not part of the shot, which has {} frames from {} to {}", text,
                                            frames.size(), frames.front().frame, frames.back().frame));
}

// Real time: a frame is shown until the next one's time has come, and at least once; those whose time passes meanwhile
// are dropped.
void LiveSession::tick(double seconds) {
  watch_shot();
  if (arguments_.autosave) autosave(seconds);
  look_for_files(seconds);
  if (!playing_) return;
  if (!play_start_) {
    play_start_ = seconds;
    play_from_ = frame_;
  }
  const auto passed = static_cast<std::size_t>(std::max(0., std::floor((seconds - *play_start_) * fps_)));
  const std::size_t target = play_from_ + passed, count = open_->shot.sequence().frames.size();
  if (target <= frame_ || open_->engine.shown()->request != request_) return;
  if (target < count) {
    dropped_ += static_cast<std::int64_t>(target - frame_ - 1);
    return go_to(target);
  }
  dropped_ += static_cast<std::int64_t>(count - 1 - frame_);
  if (loop_) {
    play_start_ = seconds;
    play_from_ = 0;
    go_to(0);
  } else if (frame_ + 1 < count) {
    go_to(count - 1);
  } else {
    playing_ = false;
    wish();  // without hurry
  }
}

void LiveSession::act(const Action& action) noexcept {
  try {
    perform(action);
  } catch (const std::exception& error) {
    say(error.what(), true);
  }
}

}  // namespace pullfocus::cli::preview
