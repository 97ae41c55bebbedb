// SPDX-License-Identifier: MIT
// Stands for the headers that most tests include, which CMake precompiles for this source and lends to theirs.
