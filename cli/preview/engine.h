// The filter on a thread of its own: takes the last wish, shows a first picture soon and refines it until the next
// wish.
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>

#include "filter/filter.h"
#include "preview/frame_cache.h"
#include "preview/refinement.h"
#include "preview/screen.h"
#include "preview/state.h"

namespace pullfocus::cli::preview {

// What the exact picture depends on beside frame and lens. Another object, another filter.
struct FilterSetup {
  FilterOptions options;
  std::string method;  // for the headers of files
};

struct Wish {
  std::uint64_t id = 0;  // rises
  std::size_t frame = 0;
  std::shared_ptr<const Camera> camera;
  std::shared_ptr<const FilterSetup> setup;
  Budget budget;         // of the first picture and of every further one
  bool refine = true;    // go on to the exact picture
  bool hurried = false;  // more wishes are coming, as while something is dragged: nothing that takes long is begun
  Look look;
};

// An exact picture.
struct Exact {
  const ColourImage& colour;
  Window window;  // result window
};

class Engine {
 public:
  // `shot` and `cache` must live as long; on_read() is to be called when the cache has read a frame. `on_shown` is
  // called from the engine's thread whenever there is something new to show.
  Engine(const Shot& shot, FrameCache& cache, std::function<void()> on_shown);
  ~Engine();  // ends within one slice or one rebuild

  void want(Wish wish);
  void on_read();
  std::shared_ptr<const Shown> shown() const;

  // Calls `take` on the engine's thread with the exact picture of the wish, or with null and why there is none; before
  // any later wish is looked at.
  using Take = std::function<void(const Exact*, const std::string& problem)>;
  void finish(Wish wish, Take take);

  bool is_ordered() const;  // pictures to finish() that are not delivered yet

  // Whether the last wish is done: exact, or as far as it goes, or given up.
  bool is_settled() const;

 private:
  struct Order {
    Wish wish;
    Take take;
  };

  enum class Next { more, file, nothing };  // to do for a wish: more at once, once its file is read, or nothing

  void work();
  Next step(const Wish& wish, bool to_the_end);
  void deliver(const Take& take);
  void show(const Wish& wish);
  bool is_newer_wanted(std::uint64_t id) const;
  void publish(Shown shown);
  void make_full(const Wish& wish);

  const Shot& shot_;
  FrameCache& cache_;
  const std::function<void()> on_shown_;

  mutable std::mutex mutex_;
  std::condition_variable wake_;
  Wish wanted_;
  std::deque<Order> orders_;
  bool stop_ = false, poked_ = false, settled_ = true;
  std::shared_ptr<const Shown> shown_;

  // Of the engine's thread:
  std::shared_ptr<const FilterSetup> setup_;
  std::shared_ptr<const ShotFrame> frame_;
  CocFunction coc_;
  std::unique_ptr<Filter> filter_, linear_;
  Refinement refinement_;
  bool has_result_ = false;        // filter_ holds a picture of frame_ and coc_,
  bool complete_ = false;          // and nothing is left over
  bool full_is_valid_ = false;     // linear_ holds the full solution
  bool picture_is_valid_ = false;  // now_.picture shows what there is, as looked_ says
  Look looked_;
  ToneTable tone_;
  Shown now_;
  std::thread thread_;
};

}  // namespace pullfocus::cli::preview
