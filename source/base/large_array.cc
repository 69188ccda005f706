// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/base/large_array.h>

#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <new>

namespace myolines
{
  namespace
  {
    constexpr std::size_t alignment_of_small = 64;

    std::size_t rounded_up(const std::size_t bytes, const std::size_t unit) { return (bytes + unit - 1) / unit * unit; }

    /// Pages of its own, which the system has back as soon as they are not needed.
    bool is_large(const std::size_t bytes) { return bytes >= (std::size_t(1) << 17); }

    /// Pages that begin where a large one may: more are taken, and what stands over is given back.
    void *map_large_pages(const std::size_t bytes)
    {
      constexpr std::size_t page  = LargeMemory::large_page;
      void                 *taken = mmap(nullptr, bytes + page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
      if (taken == MAP_FAILED)
        throw std::bad_alloc();
      char             *first  = static_cast<char *>(taken);
      const std::size_t before = rounded_up(reinterpret_cast<std::uintptr_t>(taken), page) - reinterpret_cast<std::uintptr_t>(taken);
      if (before > 0)
        munmap(first, before);
      if (before < page)
        munmap(first + before + bytes, page - before);
#ifdef MADV_HUGEPAGE
      madvise(first + before, bytes / page * page, MADV_HUGEPAGE); // advice: small pages do as well where it is not taken
#endif
      return first + before;
    }
  } // namespace

  LargeMemory::LargeMemory(const std::size_t bytes)
  {
    if (bytes == 0)
      return;
    bytes_ = rounded_up(bytes, alignment_of_small);
    if (is_large(bytes_))
      {
        bytes_ = rounded_up(bytes_, sysconf(_SC_PAGE_SIZE));
        begin_ = map_large_pages(bytes_);
        return;
      }
    begin_ = std::aligned_alloc(alignment_of_small, bytes_);
    if (begin_ == nullptr)
      throw std::bad_alloc();
    std::memset(begin_, 0, bytes_);
  }

  LargeMemory::~LargeMemory()
  {
    if (begin_ == nullptr)
      return;
    if (is_large(bytes_))
      munmap(begin_, bytes_);
    else
      std::free(begin_);
  }
} // namespace myolines
