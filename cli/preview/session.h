// What a preview window talks to: it draws the snapshot and hands over what the user does. Nothing here waits for a
// file or for the filter.
#pragma once

#include <functional>

#include "preview/action.h"
#include "preview/state.h"

namespace pullfocus::cli::preview {

class Session {
 public:
  virtual ~Session() = default;

  // Does it, or says in the snapshot's message why not.
  virtual void act(const Action& action) noexcept = 0;

  virtual Snapshot snapshot() = 0;

  // What the input and the lens have at pixel (x, y) of the state window, counted from its corner, in the frame shown.
  virtual Probe probe(int x, int y) = 0;

  // Lets time pass: playing goes on. Seconds since any fixed time.
  virtual void tick(double seconds) = 0;

  // `wake` is called from any thread when the snapshot has changed; empty: nobody is. What was given before is not
  // called any more once this has returned. It must not call the session.
  virtual void on_change(std::function<void()> wake) = 0;
};

}  // namespace pullfocus::cli::preview
