#pragma once
/// Many short tasks shared out over threads that live as long as the tasks.

#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace maggic {

/// Does every task below `tasks` once, on `threads` threads (at least 1), the caller's among them.
/// Each thread takes the next task as soon as it is done with one.
/// @param make_worker called once on every thread; returns what does a task, called with its
/// number.
/// @throws the first thing any of them threw; tasks not begun by then are left undone.
template <class MakeWorker>
void share_out(std::size_t tasks, unsigned threads, const MakeWorker& make_worker) {
  std::atomic<std::size_t> next_task{0};
  std::mutex failure_mutex;
  std::exception_ptr failure;
  const auto work = [&] {
    try {
      auto worker = make_worker();
      for (std::size_t task = next_task++; task < tasks; task = next_task++) worker(task);
    } catch (...) {
      const std::lock_guard lock(failure_mutex);
      if (!failure) failure = std::current_exception();
      next_task = tasks;
    }
  };
  {
    std::vector<std::jthread> others;
    for (unsigned i = 1; i < threads; ++i) others.emplace_back(work);
    work();
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace maggic
