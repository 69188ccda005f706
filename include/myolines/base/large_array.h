// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstddef>
#include <type_traits>
#include <utility>

namespace myolines
{
  /// Bytes of one array. What of them fills large pages is asked of the system in such (madvise, MADV_HUGEPAGE): a stream through memory
  /// then spares the walk through a table of many small ones. Where the system has no large pages, or refuses them, they are small.
  class LargeMemory
  {
  public:
    static constexpr std::size_t large_page = std::size_t(1) << 21; ///< 2 MiB

    LargeMemory() = default; ///< Nothing.

    /// All zero, aligned to 64 bytes. @throws std::bad_alloc
    explicit LargeMemory(std::size_t bytes);
    ~LargeMemory();                                            ///< Gives the memory back.
    LargeMemory(LargeMemory &&other) noexcept { swap(other); } ///< Takes the memory over.
    /// Gives its own memory back and takes that of @p other over.
    LargeMemory &operator=(LargeMemory other) noexcept
    {
      swap(other);
      return *this;
    }

    void *begin() const { return begin_; } ///< The first byte; nullptr if there are none.

  private:
    void swap(LargeMemory &other)
    {
      std::swap(begin_, other.begin_);
      std::swap(bytes_, other.bytes_);
    }

    void       *begin_ = nullptr;
    std::size_t bytes_ = 0;
  };

  /// Numbers in such memory: for arrays that grow with the mesh.
  template <typename Number>
  class LargeArray
  {
    static_assert(std::is_arithmetic<Number>::value, "bytes that are zero must be a number");

  public:
    LargeArray() = default; ///< Empty.
    /// @p size zeros. @throws std::bad_alloc
    explicit LargeArray(const std::size_t size)
      : memory_(size * sizeof(Number))
      , size_(size)
    {}
    /// Takes the numbers over; @p other is empty then.
    LargeArray(LargeArray &&other) noexcept
      : memory_(std::move(other.memory_))
      , size_(std::exchange(other.size_, 0))
    {}
    /// Gives its own numbers up and takes those of @p other over.
    LargeArray &operator=(LargeArray other) noexcept
    {
      memory_ = std::move(other.memory_);
      size_   = other.size_;
      return *this;
    }

    /// Zeros if the size changes; else all stays as it is.
    void resize(const std::size_t size)
    {
      if (size == size_)
        return;
      *this = LargeArray(); // what there was makes room first
      *this = LargeArray(size);
    }

    bool        empty() const { return size_ == 0; }              ///< Whether there are no numbers.
    std::size_t size() const { return size_; }                    ///< How many numbers there are.
    std::size_t memory() const { return size_ * sizeof(Number); } ///< bytes
    ///@{
    /// The numbers, one behind the other; @p i below size(), which is not checked.
    Number       *data() { return static_cast<Number *>(memory_.begin()); }
    const Number *data() const { return static_cast<const Number *>(memory_.begin()); }
    Number       *begin() { return data(); }
    const Number *begin() const { return data(); }
    Number       *end() { return data() + size_; }
    const Number *end() const { return data() + size_; }
    Number       &operator[](const std::size_t i) { return data()[i]; }
    const Number &operator[](const std::size_t i) const { return data()[i]; }
    ///@}

  private:
    LargeMemory memory_;
    std::size_t size_ = 0;
  };
} // namespace myolines
