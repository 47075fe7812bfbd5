#include "scan/band_workers.hpp"

#include <utility>

namespace maggic {

BandWorkers::BandWorkers(std::size_t bands) : failures_(bands) {
  threads_.reserve(bands - 1);
  try {
    for (std::size_t band = 1; band < bands; ++band) {
      threads_.emplace_back([this, band] { serve(band); });
    }
  } catch (...) {
    stop();  // Those that did start.
    throw;
  }
}

BandWorkers::~BandWorkers() { stop(); }

void BandWorkers::stop() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  begun_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

void BandWorkers::run_erased(Function function, void* context) {
  {
    const std::lock_guard lock(mutex_);
    function_ = function;
    context_ = context;
    running_ = threads_.size();
    ++round_;
  }
  begun_.notify_all();
  do_band(0);
  {
    std::unique_lock lock(mutex_);
    done_.wait(lock, [this] { return running_ == 0; });
  }
  std::exception_ptr first;
  for (std::exception_ptr& failure : failures_) {
    std::exception_ptr taken = std::exchange(failure, nullptr);
    if (!first) first = std::move(taken);
  }
  if (first) std::rethrow_exception(first);
}

void BandWorkers::serve(std::size_t band) {
  std::uint64_t served = 0;
  for (;;) {
    {
      std::unique_lock lock(mutex_);
      begun_.wait(lock, [&] { return stopping_ || round_ != served; });
      if (stopping_) return;
      served = round_;
    }
    do_band(band);
    const std::lock_guard lock(mutex_);
    if (--running_ == 0) done_.notify_one();
  }
}

void BandWorkers::do_band(std::size_t band) {
  try {
    function_(context_, band);
  } catch (...) {
    failures_[band] = std::current_exception();
  }
}

}  // namespace maggic
