#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace sketchloc::detail {

/// A large block of zero bytes, on huge pages where the system has them: a table that is read at
/// random would otherwise miss the address cache at nearly every look-up (range_table_bench).
class HugePages {
 public:
  HugePages() = default;
  explicit HugePages(std::size_t bytes);
  ~HugePages();
  HugePages(HugePages&& other) noexcept;
  HugePages& operator=(HugePages&& other) noexcept;
  HugePages(const HugePages&) = delete;
  HugePages& operator=(const HugePages&) = delete;

  std::span<std::int8_t> bytes() { return {data_, size_}; }
  std::span<const std::int8_t> bytes() const { return {data_, size_}; }

 private:
  std::int8_t* data_ = nullptr;
  std::size_t size_ = 0;
};

}  // namespace sketchloc::detail
