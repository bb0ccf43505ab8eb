#pragma once

#include <cstddef>
#include <functional>

namespace irido {

/// Calls work(i) once for every i in [0, count) on up to `threads` threads (0: one per core) and
/// returns when all are done. The assignment of i to threads is unspecified, so each work(i) must
/// write to memory of its own; the first exception thrown is rethrown here.
void parallel_for(std::size_t count, unsigned threads,
                  const std::function<void(std::size_t)>& work);

}  // namespace irido
