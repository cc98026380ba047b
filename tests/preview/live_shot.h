// A shot on disk, and sessions over it.
#pragma once

#include "filter/linear_filter.h"
#include "preview/live_session.h"
#include "program.h"

namespace pullfocus::cli::preview::test {

using pullfocus::test::TempFolder;

// Frames 1 .. last of write_shot() in a folder that goes with it.
struct LiveShot {
  explicit LiveShot(int last = 4);

  PreviewArguments arguments() const;
  std::string pattern() const { return folder / "shot.####.exr"; }

  TempFolder folder;
};

// Lets the session's threads work until it is settled, writes nothing and plays no more.
void settle(LiveSession& session);

// The linear filter's picture of a frame as read from its file, with the camera and the setup.
ColourImage linear_picture(const Shot& shot, std::size_t frame, const Camera& camera, const FilterSetup& setup);

}  // namespace pullfocus::cli::preview::test
