// A shot that is open: its files, its frames in memory, and the filter on its thread.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>

#include "preview/engine.h"
#include "preview/frame_cache.h"
#include "shot.h"

namespace pullfocus::cli::preview {

// Files of a shot and when they were last written.
using FileTimes = std::map<std::string, std::filesystem::file_time_type>;

// Of all frames that the pattern finds; empty if its folder cannot be read. Looks at the disk.
FileTimes file_times(const exr::Pattern& pattern);

struct OpenShot {
  // Reads all headers; frames that cannot be used are listed with their problem. Throws Error. `on_shown` as of Engine.
  OpenShot(const InputArguments& input, const CameraArguments& camera, std::size_t cache_bytes,
           std::function<void()> on_shown);
  ~OpenShot() { cache.stop(); }  // before the engine ends, which it tells of frames

  const FileTimes times;                   // before anything was read
  const std::shared_ptr<const Shot> kept;  // for work that may outlast this
  const Shot& shot;
  FrameCache cache;
  Engine engine;
};

}  // namespace pullfocus::cli::preview
