#pragma once
/// A bounded number of threads that serve connections.

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

#include "studio/server/socket.hpp"

namespace maggic::studio {

/// Threads are made when connections wait and all there are have work. Connections are served in
/// the order they came.
class Workers {
 public:
  /// @param most threads, at least 1. @param serve called from several threads; must not throw.
  Workers(std::size_t most, std::function<void(Socket)> serve);
  /// Serves what waits, then ends the threads.
  ~Workers();
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

  void add(Socket connection);
  /// Whether connections wait for a thread.
  bool crowded() const { return crowded_; }

 private:
  void work();

  const std::size_t most_;
  const std::function<void(Socket)> serve_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Socket> waiting_;
  std::atomic<bool> crowded_{false};
  std::size_t idle_ = 0;  ///< Threads that wait for connections, or are about to.
  bool ending_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace maggic::studio
