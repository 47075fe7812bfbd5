#pragma once
/// Memory for tables that are looked up at random, in the largest pages there are.

#include <cstddef>

namespace maggic {

/// Memory of any content that begins with a cache line. From 1 MiB on it begins with a huge page
/// (2 MiB), and the kernel is asked for such pages: a look-up then seldom waits for the address of
/// its page, which for a table of 3 MB shortens a scan with cold caches by about a tenth. Where the
/// kernel has none to give, or none at all, the pages are ordinary.
/// @throws std::bad_alloc
void* allocate_table_memory(std::size_t bytes);

/// @param bytes as allocated.
void free_table_memory(void* memory, std::size_t bytes);

}  // namespace maggic
