// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Counts what C++ code of a program and of its libraries has on the heap: include it in one source
 * file of an executable, whose operator new then replaces all others.
 */

#ifndef HeapCounter_h
#define HeapCounter_h

#include <malloc.h>

#include <atomic>
#include <cstdlib>
#include <new>

namespace heap
{
inline std::atomic<long> Bytes{ 0 };
inline std::atomic<long> Peak{ 0 };

inline void* Allocate(std::size_t size, std::size_t alignment = 0)
{
  void* block = alignment > 0 ? std::aligned_alloc(alignment, (size / alignment + 1) * alignment)
                              : std::malloc(size);
  if (!block)
  {
    throw std::bad_alloc();
  }
  const long now = Bytes += static_cast<long>(malloc_usable_size(block));
  for (long peak = Peak; now > peak && !Peak.compare_exchange_weak(peak, now);)
  {
  }
  return block;
}

inline void Free(void* block)
{
  if (block)
  {
    Bytes -= static_cast<long>(malloc_usable_size(block));
    std::free(block);
  }
}
} // namespace heap

void* operator new(std::size_t size) { return heap::Allocate(size); }
void* operator new[](std::size_t size) { return heap::Allocate(size); }
void* operator new(std::size_t size, std::align_val_t alignment)
{
  return heap::Allocate(size, static_cast<std::size_t>(alignment));
}
void* operator new[](std::size_t size, std::align_val_t alignment)
{
  return heap::Allocate(size, static_cast<std::size_t>(alignment));
}
// Those that do not throw, too: the library's allocate elsewhere under the address sanitizer.
void* operator new(std::size_t size, const std::nothrow_t&) noexcept
{
  try
  {
    return heap::Allocate(size);
  }
  catch (const std::bad_alloc&)
  {
    return nullptr;
  }
}
void* operator new[](std::size_t size, const std::nothrow_t& nothrow) noexcept
{
  return operator new(size, nothrow);
}
void operator delete(void* block) noexcept { heap::Free(block); }
void operator delete[](void* block) noexcept { heap::Free(block); }
void operator delete(void* block, std::size_t) noexcept { heap::Free(block); }
void operator delete[](void* block, std::size_t) noexcept { heap::Free(block); }
void operator delete(void* block, std::align_val_t) noexcept { heap::Free(block); }
void operator delete[](void* block, std::align_val_t) noexcept { heap::Free(block); }
void operator delete(void* block, std::size_t, std::align_val_t) noexcept { heap::Free(block); }
void operator delete[](void* block, std::size_t, std::align_val_t) noexcept { heap::Free(block); }

#endif
