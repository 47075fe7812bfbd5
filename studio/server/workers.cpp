#include "studio/server/workers.hpp"

#include <system_error>
#include <utility>

namespace maggic::studio {

Workers::Workers(std::size_t most, std::function<void(Socket)> serve)
    : most_(most), serve_(std::move(serve)) {}

Workers::~Workers() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  changed_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

void Workers::add(Socket connection) {
  {
    const std::lock_guard lock(mutex_);
    waiting_.push_back(std::move(connection));
    if (waiting_.size() > idle_ && threads_.size() < most_) {
      try {
        threads_.emplace_back([this] { work(); });
        ++idle_;
      } catch (const std::system_error&) {
        // A machine out of threads still has those made earlier; without any, nobody is served.
        if (threads_.empty()) waiting_.pop_back();
      }
    }
    crowded_ = waiting_.size() > idle_;
  }
  changed_.notify_one();
}

void Workers::work() {
  std::unique_lock lock(mutex_);
  for (;;) {
    changed_.wait(lock, [this] { return ending_ || !waiting_.empty(); });
    --idle_;
    if (waiting_.empty()) return;
    Socket next = std::move(waiting_.front());
    waiting_.pop_front();
    crowded_ = waiting_.size() > idle_;
    lock.unlock();
    serve_(std::move(next));
    lock.lock();
    ++idle_;
    crowded_ = waiting_.size() > idle_;
  }
}

}  // namespace maggic::studio
