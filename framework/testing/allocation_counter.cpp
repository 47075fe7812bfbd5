#include "testing/allocation_counter.hpp"

#include <atomic>
#include <cstdlib>
#include <new>

#include <opencv2/core/mat.hpp>

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define MAGGIC_COUNTS_ALLOCATIONS 0
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define MAGGIC_COUNTS_ALLOCATIONS 0
#endif
#endif
#ifndef MAGGIC_COUNTS_ALLOCATIONS
#define MAGGIC_COUNTS_ALLOCATIONS 1
#endif

namespace maggic::testing {
namespace {

std::atomic<std::uint64_t> allocations{0};
thread_local std::uint64_t allocations_of_this_thread = 0;

[[maybe_unused]] void count_one() noexcept {
  allocations.fetch_add(1, std::memory_order_relaxed);
  ++allocations_of_this_thread;
}

/// Counts, and leaves the work to OpenCV's own allocator.
class CountingMatAllocator final : public cv::MatAllocator {
 public:
  cv::UMatData* allocate(int dims, const int* sizes, int type, void* data, std::size_t* step,
                         cv::AccessFlag flags, cv::UMatUsageFlags usage) const override {
    if (data == nullptr) count_one();
    return standard_->allocate(dims, sizes, type, data, step, flags, usage);
  }
  bool allocate(cv::UMatData* data, cv::AccessFlag flags, cv::UMatUsageFlags usage) const override {
    return standard_->allocate(data, flags, usage);
  }
  void deallocate(cv::UMatData* data) const override { standard_->deallocate(data); }

 private:
  cv::MatAllocator* standard_ = cv::Mat::getStdAllocator();
};

#if MAGGIC_COUNTS_ALLOCATIONS
// Before main, while no other thread makes pictures. Never destroyed: pictures may be made until
// the program's very end.
[[maybe_unused]] const bool counts_pictures = [] {
  cv::Mat::setDefaultAllocator(new CountingMatAllocator);
  return true;
}();
#endif

}  // namespace

bool AllocationCounter::works() { return MAGGIC_COUNTS_ALLOCATIONS != 0; }

AllocationCounter::AllocationCounter()
    : before_(allocations.load(std::memory_order_relaxed)),
      before_of_this_thread_(allocations_of_this_thread) {}

std::uint64_t AllocationCounter::count() const {
  return allocations.load(std::memory_order_relaxed) - before_;
}

std::uint64_t AllocationCounter::count_of_this_thread() const {
  return allocations_of_this_thread - before_of_this_thread_;
}

}  // namespace maggic::testing

#if MAGGIC_COUNTS_ALLOCATIONS

// The other forms of new and delete come down to these by default.
void* operator new(std::size_t size) {
  maggic::testing::count_one();
  if (void* memory = std::malloc(size != 0 ? size : 1)) return memory;
  throw std::bad_alloc();
}

void* operator new(std::size_t size, std::align_val_t alignment) {
  maggic::testing::count_one();
  const auto step = static_cast<std::size_t>(alignment);
  if (void* memory = std::aligned_alloc(step, (size + step - 1) / step * step)) return memory;
  throw std::bad_alloc();
}

void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }

#endif
