// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <exception>
#include <string>

namespace batten {

/// The text of the `Expected` error that `call` throws; "nothing thrown" or "another error: ..." otherwise.
template <std::derived_from<std::exception> Expected, std::invocable Call>
std::string message_of(const Call& call) {
  try {
    call();
  } catch (const Expected& error) {
    return error.what();
  } catch (const std::exception& error) {
    return std::string("another error: ") + error.what();
  }
  return "nothing thrown";
}

}  // namespace batten
