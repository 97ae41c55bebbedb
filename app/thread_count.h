// SPDX-License-Identifier: MIT
#pragma once

namespace batten {

/// Lets the work that follows use `threads` threads; 0 leaves the choice to the machine.
void set_thread_count(int threads);

/// What --threads accepts at most.
inline constexpr int most_threads = 1024;

}  // namespace batten
