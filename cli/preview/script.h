// Recorded actions without a window.
#pragma once

#include <string>

#include "preview/live_session.h"

namespace pullfocus::cli::preview {

// Does what the script says, line by line (see action.h): the session's verbs, and
//
//   wait          until what was asked for is exact (with refine off: shown), nothing is being written, and playing has
//   ended show FILE     write what the picture shows now, as a picture status        a line of JSON on standard output:
//   frame, pending pixels, error bound, settings sleep MS      let time pass quit          end here
//
// Errors of the session go to stderr as they come. Returns the exit code: 1 if something could not be read or written.
// Throws Error(unreadable) if there is no such file, Error(usage) naming file and line for what is no action.
int run_script(LiveSession& session, const std::string& file);

}  // namespace pullfocus::cli::preview
