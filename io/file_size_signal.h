// SPDX-License-Identifier: MIT
#pragma once

#include <csignal>

namespace batten {

/// While one lives, a write of this thread beyond the file size limit fails with EFBIG, as on a full disk, instead of
/// ending the process by SIGXFSZ. The process's own handling of that signal is not touched.
class FileSizeSignalBlock {
public:
  FileSizeSignalBlock();
  ~FileSizeSignalBlock();
  FileSizeSignalBlock(const FileSizeSignalBlock&) = delete;
  FileSizeSignalBlock& operator=(const FileSizeSignalBlock&) = delete;

private:
  sigset_t signal_;
  sigset_t before_;  // the thread's mask
  bool was_pending_;
};

}  // namespace batten
