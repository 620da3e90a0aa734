// SPDX-License-Identifier: MIT
#include "support/heap.h"

#if defined(__GLIBC__)
#include <malloc.h>
#endif

namespace conelight::test {

std::size_t heapBytes() {
#if defined(__GLIBC__) && (__GLIBC__ > 2 || __GLIBC_MINOR__ >= 33)
    const struct mallinfo2 info = mallinfo2();
    return info.uordblks + info.hblkhd;
#else
    return 0;
#endif
}

}  // namespace conelight::test
