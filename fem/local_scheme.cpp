// SPDX-License-Identifier: MIT
#include <batten/bases/blocks.h>
#include <batten/domains/errors.h>
#include <batten/fem/local_scheme.h>
#include <batten/fem/patch.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <string>
#include <string_view>
#include <unordered_map>

namespace batten {
namespace {

/// Numbers for equal pieces of data: equal bits, equal number.
class Classes {
public:
  void add(double value) {
    value += 0.;  // -0 is 0
    text_.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  int number() {
    const auto [entry, is_new] = known_.try_emplace(text_, static_cast<int>(known_.size()));
    text_.clear();
    return entry->second;
  }

private:
  std::string text_;
  std::unordered_map<std::string, int> known_;
};

std::uint64_t hash_of(const std::vector<int>& key) {
  return std::hash<std::string_view>{}({reinterpret_cast<const char*>(key.data()), key.size() * sizeof(int)});
}

/// Numbers for the cells of the fine level: equal for cells of equal energy.
std::vector<int> cell_classes(const SplineLevel& fine) {
  Classes classes;
  std::vector<int> result;
  for (int cy = 0; cy < fine.y().cells(); ++cy)
    for (int cx = 0; cx < fine.x().cells(); ++cx) {
      if (!fine.is_inside(cx, cy)) {
        result.push_back(-1);
        continue;
      }
      const auto element = fine.element(cx, cy);
      for (double e : element.reshaped()) classes.add(e);
      result.push_back(classes.number());
    }
  return result;
}

}  // namespace

/// Finds the rules of a LocalScheme.
class LocalSchemeBuilder {
public:
  LocalSchemeBuilder(LocalScheme& scheme, const SplineLevel& coarse, const SplineLevel& fine, Measurement kind,
                     int layers)
      : scheme_(scheme),
        step_{coarse, fine, scheme.measurements_, scheme.private_, kind},
        layers_(layers),
        cells_(cell_classes(fine)),
        places_x_(places_around(coarse.x(), kind, layers)),
        places_y_(places_around(coarse.y(), kind, layers)) {
    classify_places();
    share_functions();
  }

  void build() {
    std::unordered_multimap<std::uint64_t, int> known;
    std::vector<int> cell_of_rule;
    scheme_.rule_of_.assign(functions_of_.size(), -1);
    for (std::size_t c = 0; c < functions_of_.size(); ++c) {
      if (functions_of_[c].empty()) continue;
      const auto key = key_of(static_cast<int>(c));
      const std::uint64_t hash = hash_of(key);
      int& rule = scheme_.rule_of_[c];
      for (auto [k, end] = known.equal_range(hash); k != end && rule < 0; ++k)
        if (key_of(cell_of_rule[static_cast<std::size_t>(k->second)]) == key) rule = k->second;
      if (rule >= 0) continue;
      rule = static_cast<int>(cell_of_rule.size());
      known.emplace(hash, rule);
      cell_of_rule.push_back(static_cast<int>(c));
    }
    scheme_.rules_.resize(cell_of_rule.size());
    std::vector<char> failed(cell_of_rule.size(), 0);
    const int count = static_cast<int>(cell_of_rule.size());
#pragma omp parallel for schedule(dynamic, 1)
    for (int r = 0; r < count; ++r) {
      const auto i = static_cast<std::size_t>(r);
      failed[i] = !solve(cell_of_rule[i], scheme_.rules_[i]);
    }
    if (std::find(failed.begin(), failed.end(), 1) != failed.end())
      throw SolverError("LocalScheme: expected measurements that fix the functions without energy, found too few");
  }

private:
  void classify_places();
  void share_functions();
  Patch patch_around(int cell, int layers) const;
  std::vector<int> key_of(int cell) const;
  bool solve(int cell, LocalScheme::Rule& rule) const;

  LocalScheme& scheme_;
  PatchedStep step_;
  int layers_;
  std::vector<int> cells_, places_;  // classes of fine cells and of places
  std::vector<PlaceRange> places_x_, places_y_;
  std::vector<std::vector<int>> functions_of_;  // of each coarse cell, those that are not private
};

void LocalSchemeBuilder::classify_places() {
  Classes classes;
  const auto& m = scheme_.measurements_;
  const int width = step_.fine.x().size();
  for (std::size_t place = 0; place < m.row.size(); ++place) {
    const int row = m.row[place];
    if (row < 0) {
      places_.push_back(-1);
      continue;
    }
    const int i = static_cast<int>(place) % m.places_x, j = static_cast<int>(place) / m.places_x;
    for (MeasurementMatrix::Matrix::InnerIterator e(m.M, row); e; ++e) {
      const int grid = step_.fine.grid(static_cast<int>(e.col()));
      const int gx = grid % width, gy = grid / width;
      classes.add(gx - 2 * i);
      classes.add(gy - 2 * j);
      classes.add(e.value());
    }
    places_.push_back(classes.number());
  }
}

/// Each function goes to the coarse cell of the middle of its support, or of the nearest part inside the domain.
void LocalSchemeBuilder::share_functions() {
  const SplineLevel& fine = step_.fine;
  functions_of_.resize(static_cast<std::size_t>(scheme_.cells_x_) * static_cast<std::size_t>(scheme_.cells_y_));
  std::vector<char> is_private(static_cast<std::size_t>(fine.size()), 0);
  for (int p : scheme_.private_) is_private[static_cast<std::size_t>(p)] = 1;
  for (int f = 0; f < fine.size(); ++f) {
    if (is_private[static_cast<std::size_t>(f)]) continue;
    const int gx = fine.grid(f) % fine.x().size(), gy = fine.grid(f) / fine.x().size();
    const int dx = fine.x().degree(), dy = fine.y().degree();
    int best_x = 0, best_y = 0, least = std::numeric_limits<int>::max();
    for (int cy = std::max(0, gy - dy); cy <= std::min(gy, fine.y().cells() - 1); ++cy)
      for (int cx = std::max(0, gx - dx); cx <= std::min(gx, fine.x().cells() - 1); ++cx) {
        const int distance = std::abs(cx - (gx - dx / 2)) + std::abs(cy - (gy - dy / 2));
        if (!fine.is_inside(cx, cy) || distance >= least) continue;
        least = distance;
        best_x = cx;
        best_y = cy;
      }
    const int I = fine.x().breakpoints().parent(best_x);
    const int J = fine.is_interval() ? 0 : fine.y().breakpoints().parent(best_y);
    functions_of_[static_cast<std::size_t>(I + J * scheme_.cells_x_)].push_back(f);
  }
}

Patch LocalSchemeBuilder::patch_around(int cell, int layers) const {
  const int I = cell % scheme_.cells_x_, J = cell / scheme_.cells_x_;
  const auto x = layers == layers_ ? places_x_[static_cast<std::size_t>(I)]
                                   : places_around(step_.coarse.x(), step_.kind, layers)[static_cast<std::size_t>(I)];
  const auto y = layers == layers_ ? places_y_[static_cast<std::size_t>(J)]
                                   : places_around(step_.coarse.y(), step_.kind, layers)[static_cast<std::size_t>(J)];
  return {std::max(0, I - layers),
          std::min(scheme_.cells_x_ - 1, I + layers),
          std::max(0, J - layers),
          std::min(scheme_.cells_y_ - 1, J + layers),
          x,
          y};
}

/// All that the rule depends on, relative to the cell.
std::vector<int> LocalSchemeBuilder::key_of(int cell) const {
  const Patch p = patch_around(cell, layers_);
  const int I = cell % scheme_.cells_x_, J = cell / scheme_.cells_x_;
  const auto &bx = step_.fine.x().breakpoints(), &by = step_.fine.y().breakpoints();
  const int end_x = bx.first_child(p.last_x + 1), end_y = step_.fine.is_interval() ? 1 : by.first_child(p.last_y + 1);
  std::vector<int> key = {p.first_x - I,        p.last_x - I,      p.first_y - J,        p.last_y - J,
                          end_x - 2 * I,        end_y - 2 * J,     p.places_x.begin - I, p.places_x.end - I,
                          p.places_y.begin - J, p.places_y.end - J};
  for (int cy = step_.fine.is_interval() ? 0 : by.first_child(p.first_y); cy < end_y; ++cy)
    for (int cx = bx.first_child(p.first_x); cx < end_x; ++cx)
      key.push_back(cells_[static_cast<std::size_t>(cx + cy * step_.fine.x().cells())]);
  for (int j = p.places_y.begin; j < p.places_y.end; ++j)
    for (int i = p.places_x.begin; i < p.places_x.end; ++i)
      key.push_back(places_[static_cast<std::size_t>(i + j * scheme_.measurements_.places_x)]);
  const int anchor = 2 * (I + J * scheme_.functions_x_);
  for (int f : functions_of_[static_cast<std::size_t>(cell)]) key.push_back(step_.fine.grid(f) - anchor);
  return key;
}

/// On a patch that grows until its measurements fix what has no energy (a mask may cut it into pieces).
bool LocalSchemeBuilder::solve(int cell, LocalScheme::Rule& rule) const {
  const int I = cell % scheme_.cells_x_, J = cell / scheme_.cells_x_;
  const auto& functions = functions_of_[static_cast<std::size_t>(cell)];
  const int most = std::max(scheme_.cells_x_, scheme_.cells_y_);
  for (int layers = layers_; layers < layers_ + most; ++layers) {
    const auto solution = solve_patch(step_, patch_around(cell, layers), functions);
    if (solution.weights.size() == 0) continue;
    for (int f : functions) rule.functions.push_back(step_.fine.grid(f) - 2 * (I + J * scheme_.functions_x_));
    for (int place : solution.places) rule.places.push_back(place - I - J * scheme_.measurements_.places_x);
    for (Eigen::Index f = 0; f < solution.weights.rows(); ++f)
      for (Eigen::Index w = 0; w < solution.weights.cols(); ++w) rule.weights.push_back(solution.weights(f, w));
    return true;
  }
  return false;
}

LocalScheme::LocalScheme(const SplineLevel& coarse, const SplineLevel& fine, Measurement kind, int layers)
    : measurements_(measurement_matrix(coarse, fine, kind)),
      private_(private_functions(measurements_.M)),
      cells_x_(coarse.x().cells()),
      cells_y_(coarse.y().cells()),
      functions_x_(fine.x().size()) {
  if (layers < 1) throw InvalidInput("LocalScheme: expected at least 1 layer, found " + std::to_string(layers));
  for (int r = 0; r < columns(); ++r) pivot_.push_back(measurements_.M.coeff(r, private_[static_cast<std::size_t>(r)]));
  number_.assign(static_cast<std::size_t>(fine.x().size()) * static_cast<std::size_t>(fine.y().size()), -1);
  for (int f = 0; f < fine.size(); ++f) {
    grid_.push_back(fine.grid(f));
    number_[static_cast<std::size_t>(fine.grid(f))] = f;
  }
  LocalSchemeBuilder(*this, coarse, fine, kind, layers).build();
}

/// The coefficients around coarse cell c but the private ones.
void LocalScheme::apply_rule(int c, const Eigen::VectorXd& at_place, Eigen::VectorXd& q) const {
  const int index = rule_of_[static_cast<std::size_t>(c)];
  if (index < 0) return;
  const Rule& rule = rules_[static_cast<std::size_t>(index)];
  const int I = c % cells_x_, J = c / cells_x_;
  const int function = 2 * (I + J * functions_x_), place = I + J * measurements_.places_x;
  const double* weight = rule.weights.data();
  for (int f : rule.functions) {
    double sum = 0;
    for (int p : rule.places) sum += *weight++ * at_place[place + p];
    q[number_[static_cast<std::size_t>(function + f)]] = sum;
  }
}

/// The private coefficient of measurement r, for which its value m holds.
void LocalScheme::set_private(int r, double m, Eigen::VectorXd& q) const {
  const int p = private_[static_cast<std::size_t>(r)];
  double rest = m;
  for (MeasurementMatrix::Matrix::InnerIterator e(measurements_.M, r); e; ++e)
    if (e.col() != p) rest -= e.value() * q[e.col()];
  q[p] = rest / pivot_[static_cast<std::size_t>(r)];
}

Eigen::VectorXd LocalScheme::apply(const Eigen::VectorXd& m) const {
  if (m.size() != columns())
    throw InvalidInput("LocalScheme::apply: expected " + std::to_string(columns()) + " measurements, found " +
                       std::to_string(m.size()));
  Eigen::VectorXd at_place = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(measurements_.row.size())), q(rows());
  for (int r = 0; r < columns(); ++r) at_place[measurements_.place[static_cast<std::size_t>(r)]] = m[r];
  // Every coefficient belongs to one cell, every private one to one measurement: no two threads meet.
  for_blocks(RowBlocks(cells_x_ * cells_y_, 64), [&](int begin, int end) {
    for (int c = begin; c < end; ++c) apply_rule(c, at_place, q);
  });
  for_blocks(RowBlocks(columns(), 16), [&](int begin, int end) {
    for (int r = begin; r < end; ++r) set_private(r, m[r], q);
  });
  return q;
}

Eigen::MatrixXd LocalScheme::matrix() const {
  Eigen::MatrixXd result(rows(), columns());
  for (int j = 0; j < columns(); ++j) result.col(j) = apply(Eigen::VectorXd::Unit(columns(), j));
  return result;
}

/// Rows of rules first; q_p = (m_r - Σ M_ra q_a) / M_rp then gives the private ones.
Eigen::SparseMatrix<double, Eigen::RowMajor> LocalScheme::sparse_matrix() const {
  using Matrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;
  std::vector<Eigen::Triplet<double>> entries, balance, own;
  for (int c = 0; c < cells_x_ * cells_y_; ++c) {
    if (rule_of_[static_cast<std::size_t>(c)] < 0) continue;
    const Rule& rule = rules_[static_cast<std::size_t>(rule_of_[static_cast<std::size_t>(c)])];
    const int I = c % cells_x_, J = c / cells_x_;
    const double* weight = rule.weights.data();
    for (int f : rule.functions)
      for (int p : rule.places)
        entries.emplace_back(number_[static_cast<std::size_t>(2 * (I + J * functions_x_) + f)],
                             measurements_.row[static_cast<std::size_t>(I + J * measurements_.places_x + p)],
                             *weight++);
  }
  for (int r = 0; r < columns(); ++r) {
    const auto i = static_cast<std::size_t>(r);
    own.emplace_back(private_[i], r, 1 / pivot_[i]);
    balance.emplace_back(private_[i], r, -1 / pivot_[i]);
  }
  Matrix shared(rows(), columns()), result(rows(), columns()), to_private(rows(), columns());
  shared.setFromTriplets(entries.begin(), entries.end());
  result.setFromTriplets(own.begin(), own.end());
  to_private.setFromTriplets(balance.begin(), balance.end());
  const Matrix seen = measurements_.M * shared;
  const Matrix balanced = to_private * seen;
  result += shared;
  result += balanced;
  return result;
}

std::size_t LocalScheme::stored_weights() const {
  std::size_t sum = 0;
  for (const Rule& rule : rules_) sum += rule.weights.size();
  return sum;
}

}  // namespace batten
