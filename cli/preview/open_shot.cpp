#include "preview/open_shot.h"

#include "image/error.h"

namespace pullfocus::cli::preview {

FileTimes file_times(const exr::Pattern& pattern) {
  FileTimes times;
  try {
    for (const int frame : pattern.is_single() ? std::vector{pattern.single_frame()} : pattern.discover()) {
      std::error_code gone;
      const std::string path = pattern.path(frame);
      const auto time = std::filesystem::last_write_time(path, gone);
      if (!gone) times[path] = time;
    }
  } catch (const Error&) {  // the folder is not there at the moment
  }
  return times;
}

OpenShot::OpenShot(const InputArguments& input, const CameraArguments& camera, std::size_t cache_bytes,
                   std::function<void()> on_shown)
    : times(file_times(exr::Pattern::parse(input.input))),
      kept(std::make_shared<const Shot>(input, camera, exr::BadFrames::keep)),
      shot(*kept),
      cache(shot, cache_bytes, [this] { engine.on_read(); }),
      engine(shot, cache, std::move(on_shown)) {}

}  // namespace pullfocus::cli::preview
