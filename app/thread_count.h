// SPDX-License-Identifier: MIT
#pragma once

namespace batten {

/// Lets the work that follows use `threads` threads; 0 leaves the choice to the machine.
void set_thread_count(int threads);

/// Starts the program afresh with OMP_WAIT_POLICY=passive, which the runtime library reads only when it is loaded,
/// unless the user has set how threads wait. Threads that spin while they wait make a fit ten times slower where other
/// programs need the processors as well.
void let_threads_sleep(char** arguments);

/// What --threads accepts at most.
inline constexpr int most_threads = 1024;

}  // namespace batten
