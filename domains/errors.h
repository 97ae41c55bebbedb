// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>
#include <string>

namespace batten {

/// Base of everything Batten throws. The text is one line: which function or file, what must hold, what was found.
class Error : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

/// The caller's arguments or data break a stated precondition.
class InvalidInput : public Error {
public:
  using Error::Error;
};

/// A mesh or domain whose connectivity does not allow the operation.
class TopologyError : public Error {
public:
  using Error::Error;
};

/// A factorisation or an iteration that did not reach its goal.
class SolverError : public Error {
public:
  using Error::Error;
};

/// A file that cannot be read or written.
class IoError : public Error {
public:
  using Error::Error;
};

}  // namespace batten
