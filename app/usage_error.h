// SPDX-License-Identifier: MIT
#pragma once

#include <batten/domains/errors.h>

namespace batten {

/// A command line that cannot be understood: exit status 2.
class UsageError : public Error {
public:
  using Error::Error;
};

}  // namespace batten
