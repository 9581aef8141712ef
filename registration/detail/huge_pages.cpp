#include "registration/detail/huge_pages.hpp"

#include <cstdlib>
#include <cstring>
#include <new>
#include <utility>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace sketchloc::detail {

HugePages::HugePages(std::size_t bytes) : size_(bytes) {
  constexpr std::size_t kHugePage = std::size_t{1} << 21;
  const std::size_t alignment = bytes >= kHugePage ? kHugePage : 64;
  const std::size_t whole = (bytes + alignment - 1) / alignment * alignment;
  void* block = std::aligned_alloc(alignment, whole == 0 ? alignment : whole);
  if (block == nullptr) {
    throw std::bad_alloc();
  }
#ifdef __linux__
  ::madvise(block, whole, MADV_HUGEPAGE);  // a wish; refusal costs speed only
#endif
  std::memset(block, 0, bytes);
  data_ = static_cast<std::int8_t*>(block);
}

HugePages::~HugePages() { std::free(data_); }

HugePages::HugePages(HugePages&& other) noexcept
    : data_(std::exchange(other.data_, nullptr)), size_(std::exchange(other.size_, 0)) {}

HugePages& HugePages::operator=(HugePages&& other) noexcept {
  std::swap(data_, other.data_);
  std::swap(size_, other.size_);
  return *this;
}

}  // namespace sketchloc::detail
