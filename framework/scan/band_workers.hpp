#pragma once
/// Threads that share one short task a frame.

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace maggic {

/// Runs one function for every band of a frame, each on a thread of its own that waits between the
/// frames, the first on the caller's. One caller at a time; allocates nothing after construction.
class BandWorkers {
 public:
  /// @param bands at least 1; one thread is started for each but the first.
  explicit BandWorkers(std::size_t bands);
  ~BandWorkers();

  std::size_t bands() const { return threads_.size() + 1; }

  /// Calls `work(band)` for every band and returns when all have returned.
  /// @throws what the lowest band that threw did; the others have finished then too.
  template <class Work>
  void run(Work& work) {
    run_erased([](void* context, std::size_t band) { (*static_cast<Work*>(context))(band); },
               &work);
  }

 private:
  using Function = void (*)(void* context, std::size_t band);

  void run_erased(Function function, void* context);
  void serve(std::size_t band);
  void do_band(std::size_t band);
  void stop();

  std::mutex mutex_;
  std::condition_variable begun_;
  std::condition_variable done_;
  std::uint64_t round_ = 0;
  std::size_t running_ = 0;
  bool stopping_ = false;
  Function function_ = nullptr;
  void* context_ = nullptr;
  std::vector<std::exception_ptr> failures_;  ///< By band.
  std::vector<std::thread> threads_;
};

}  // namespace maggic
