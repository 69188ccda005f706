// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/base/large_array.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <new>

namespace myolines
{
  namespace
  {
    constexpr std::size_t per_large_page = LargeMemory::large_page / sizeof(double);

    TEST(LargeArrays, AreZeroAndAligned)
    {
      for (const std::size_t size : {std::size_t(1), std::size_t(1000), per_large_page - 1, per_large_page, 3 * per_large_page + 5})
        {
          LargeArray<double> array(size);
          EXPECT_EQ(array.size(), size);
          EXPECT_EQ(std::count(array.begin(), array.end(), 0.), static_cast<long>(size));
          const std::size_t alignment = size < per_large_page ? 64 : LargeMemory::large_page;
          EXPECT_EQ(reinterpret_cast<std::uintptr_t>(array.data()) % alignment, 0u) << size;
          std::fill(array.begin(), array.end(), 1.); // to the very end
          EXPECT_EQ(array[size - 1], 1);
        }
    }

    TEST(LargeArrays, MoveAndKeepWhatTheyHold)
    {
      LargeArray<float> array;
      EXPECT_TRUE(array.empty());
      array.resize(2 * per_large_page);
      array[7]                = 3;
      const float *const data = array.data();
      array.resize(2 * per_large_page);
      EXPECT_EQ(array.data(), data);
      LargeArray<float> other = std::move(array);
      EXPECT_EQ(other.data(), data);
      EXPECT_EQ(other[7], 3);
      other.resize(8);
      EXPECT_EQ(other[7], 0);
    }

    TEST(LargeArrays, ThatTheSystemCannotGiveAreRefused)
    {
      EXPECT_THROW(LargeArray<char>(std::numeric_limits<std::size_t>::max() / 4), std::bad_alloc);
    }
  } // namespace
} // namespace myolines
