// SPDX-License-Identifier: MIT
#include <batten/io/file_size_signal.h>

#include <ctime>

namespace batten {

FileSizeSignalBlock::FileSizeSignalBlock() {
  sigset_t pending;
  sigpending(&pending);
  was_pending_ = sigismember(&pending, SIGXFSZ) == 1;
  sigemptyset(&signal_);
  sigaddset(&signal_, SIGXFSZ);
  pthread_sigmask(SIG_BLOCK, &signal_, &before_);
}

FileSizeSignalBlock::~FileSizeSignalBlock() {
  // The signal is sent to the writing thread: take ours before it is let through again.
  const timespec no_wait = {};
  if (!was_pending_) sigtimedwait(&signal_, nullptr, &no_wait);
  pthread_sigmask(SIG_SETMASK, &before_, nullptr);
}

}  // namespace batten
