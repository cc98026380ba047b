// A session over a shot on disk: what is open, what is chosen, and the threads that read, filter and write.
#pragma once

#include <fstream>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "preview/filter_process.h"
#include "preview/jobs.h"
#include "preview/open_shot.h"
#include "preview/session.h"

namespace pullfocus::cli::preview {

struct PreviewArguments {
  InputArguments input;
  CameraArguments camera;
  FilterArguments filter;
  std::string budget = "16ms";
  double cache_mb = 2048;
  std::string keys, out, record;  // files; empty: derived from the input's name, none, none
  bool live = false;              // the folder is looked at for new frames
  bool autosave = false;          // unsaved keys go to autosave_file(), once a second
};

class LiveSession final : public Session {
 public:
  // Opens the shot. Throws Error.
  explicit LiveSession(const PreviewArguments& arguments);
  ~LiveSession() override;

  void act(const Action& action) noexcept override;
  Snapshot snapshot() override;
  Probe probe(int x, int y) override;
  void tick(double seconds) override;
  void on_change(std::function<void()> wake) override;

  // As act(), but throws Error.
  void perform(const Action& action);

  bool is_settled() const;  // what was asked for last is shown, as far as it goes
  bool is_playing() const noexcept { return playing_; }
  bool is_writing() const;                   // frames or a shot
  int failures() const;                      // writes and shots that failed
  std::vector<std::string> take_messages();  // since the last call: errors with "error: " before them

  // Where unsaved keys are kept while a session runs; gone when it ends as it should. "shot.keys.toml.autosave".
  static std::string autosave_file(const std::string& keys_file) { return keys_file + ".autosave"; }

  // All verbs with their arguments and what they do, a line each.
  static std::string help();

 private:
  struct Verb;
  static const std::vector<Verb>& verbs();

  // What undo takes back.
  struct Choice {
    CameraKeys keys;
    KernelArguments kernel;
    std::string visibility;
    bool operator==(const Choice&) const = default;
  };
  using Words = std::vector<std::string>;

  int number() const { return open_->shot.sequence().frames[frame_].frame; }
  std::size_t position_of(const std::string& frame_text) const;
  void go_to(std::size_t frame);
  void say(std::string message, bool is_error = false);
  void changed() const;

  void choose(Choice choice);  // with undo
  void use(const Choice& choice);
  void wish();  // of the engine, with everything as it is now
  Wish make_wish(bool hurried);
  FilterArguments filter_of(const Choice& choice) const;
  std::shared_ptr<const FilterSetup> make_setup(const Choice& choice) const;

  std::optional<KeyedValue>& setting(CameraKeys& keys, const std::string& name) const;
  void set(const std::string& name, const std::string& text);
  SettingNow setting_now(const std::string& name) const;
  const exr::FileInfo& file_now() const;
  void focus_at(const Words& words);
  void set_key(const Words& words);
  void remove_key(const Words& words);
  void move_key(const Words& words);
  void undo(std::vector<Choice>& from, std::vector<Choice>& to);
  void save_keys(const std::string& file);
  void autosave(double seconds);
  void export_frame(const std::string& name);
  void export_shot(const std::string& out);
  int waiting_to_be_written() const;  // frames, and other work of the jobs' thread
  void look_for_files(double seconds);
  void look_at_folder(const exr::Pattern& pattern, const FileTimes& opened);  // on the jobs' thread
  void take_over_new_shot();
  void watch_shot();

  const PreviewArguments arguments_;
  Camera camera_;
  Choice choice_;
  CameraKeys saved_, autosaved_;
  double autosaved_at_ = 0;  // seconds
  std::vector<Choice> undo_, redo_;
  bool holding_ = false, held_ = false;  // a drag, and one that has an undo step already
  std::shared_ptr<const FilterSetup> setup_;
  std::string budget_text_, keys_file_;
  Budget budget_;
  bool refine_ = true;
  Look look_;
  std::size_t frame_ = 0;
  std::uint64_t request_ = 0;

  bool live_ = false;     // files are looked for
  double looked_at_ = 0;  // seconds
  FileTimes seen_;        // of the jobs' thread: when last looked

  bool playing_ = false, loop_ = true;
  double fps_ = 24;
  std::optional<double> play_start_;
  std::size_t play_from_ = 0;
  std::int64_t dropped_ = 0;

  mutable std::mutex waking_;  // held while wake_ is called: it is not once on_change() has returned
  std::function<void()> wake_;

  mutable std::mutex mutex_;  // of the following
  std::vector<std::string> messages_;
  std::string message_;
  bool message_is_error_ = false;
  int failures_ = 0;
  std::unique_ptr<OpenShot> new_shot_;  // waits to be taken over

  std::ofstream record_;
  Jobs jobs_;                       // outlive the engine, which adds to them
  std::unique_ptr<OpenShot> open_;  // another one only while nothing is written of it
  std::unique_ptr<FilterProcess> shot_run_;
};

}  // namespace pullfocus::cli::preview
