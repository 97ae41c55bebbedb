// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace batten {

/// A labelled place on an axis.
struct Tick {
  double value = 0;
  std::string label;
};

/// The multiples of 1, 2 or 5 times a power of ten in [low, high], at the smallest such step that gives at most `most`
/// of them (most >= 2). Labels have the same number of decimals. None if low = high.
std::vector<Tick> nice_ticks(double low, double high, int most);

/// `value` with the digits that tell numbers apart whose distance is `step`.
std::string number_label(double value, double step);

}  // namespace batten
