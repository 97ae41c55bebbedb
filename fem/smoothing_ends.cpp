// SPDX-License-Identifier: MIT
#include <batten/fem/smoothing_blocks.h>

#include <Eigen/LU>

namespace batten {
namespace {

/// Everything behind a knot, as what it says about the state there: Λ and η.
struct Information {
  Eigen::Matrix2d lambda;
  StateColumns eta;
};

Eigen::Matrix2d symmetric(const Eigen::Matrix2d& m) { return (m + m.transpose()) / 2; }

class Joining {
public:
  Joining(std::span<const BlockElement> elements, const StateColumns& b, const StateColumns& kappa)
      : elements_(elements), b_(b), kappa_(kappa), d_(b.cols() / static_cast<Eigen::Index>(elements.size())) {
    behind_.resize(elements.size());
    gains_.resize(elements.size());
  }

  BlockEnds open() {
    const auto zero = Information{Eigen::Matrix2d::Zero(), StateColumns::Zero(2, d_)};
    const Information all = collect(elements_.size(), zero);
    return fill(all.lambda.inverse() * all.eta);
  }

  /// The state where the curve closes, from the whole period: it is at the begin what it is at the end.
  BlockEnds closed() {
    const std::size_t last = elements_.size() - 1;
    BlockElement whole;
    StateColumns b = StateColumns::Zero(2, d_), kappa = b;
    for (std::size_t k = 0; k <= last; ++k) {
      const BlockElement& e = elements_[k];
      const Eigen::Matrix2d gain = (Eigen::Matrix2d::Identity() + whole.c * e.j).inverse();
      kappa += whole.a.transpose() * gain.transpose() * (columns(kappa_, k) - e.j * b);
      whole.j += symmetric(whole.a.transpose() * gain.transpose() * e.j * whole.a);
      b = (e.a * gain * (b + whole.c * columns(kappa_, k)) + columns(b_, k)).eval();
      whole.c = (symmetric(e.a * gain * whole.c * e.a.transpose()) + e.c).eval();
      whole.a = (e.a * gain * whole.a).eval();
    }
    const Eigen::Matrix2d open = Eigen::Matrix2d::Identity() - whole.a, pull = open.transpose() * whole.c.inverse();
    const StateColumns state = (whole.j + pull * open).inverse() * (kappa + pull * b);
    const BlockElement& e = elements_[last];
    const Eigen::Matrix2d stiff = e.c.inverse(), back = e.a.transpose() * stiff;
    const Information before = {e.j + symmetric(back * e.a),
                                columns(kappa_, last) + back * (state - columns(b_, last))};
    collect(last, before);
    BlockEnds ends = fill(state, last);
    const StateColumns begin = next_;
    ends.states.middleCols(static_cast<Eigen::Index>(last) * d_, d_) = begin;
    ends.costates.middleCols(static_cast<Eigen::Index>(last) * d_, d_) =
        stiff * (state - e.a * begin - columns(b_, last));
    return ends;
  }

private:
  Eigen::Block<const StateColumns, 2, Eigen::Dynamic, true> columns(const StateColumns& all, std::size_t k) const {
    return all.middleCols(static_cast<Eigen::Index>(k) * d_, d_);
  }

  /// From what is behind block `count` - 1 to what is behind the begin of block 0.
  Information collect(std::size_t count, Information info) {
    for (std::size_t k = count; k-- > 0;) {
      const BlockElement& e = elements_[k];
      gains_[k] = (Eigen::Matrix2d::Identity() + info.lambda * e.c).inverse();
      behind_[k] = info;
      const Eigen::Matrix2d back = e.a.transpose() * gains_[k];
      info.eta = (columns(kappa_, k) + back * (behind_[k].eta - behind_[k].lambda * columns(b_, k))).eval();
      info.lambda = (e.j + symmetric(back * behind_[k].lambda * e.a)).eval();
    }
    return info;
  }

  /// Forwards from the first state through the first `count` blocks.
  BlockEnds fill(const StateColumns& first, std::size_t count) {
    BlockEnds ends{StateColumns(2, b_.cols()), StateColumns(2, b_.cols())};
    next_ = first;
    for (std::size_t k = 0; k < count; ++k) {
      const auto at = static_cast<Eigen::Index>(k) * d_;
      const BlockElement& e = elements_[k];
      ends.states.middleCols(at, d_) = next_;
      const StateColumns mean = e.a * next_ + columns(b_, k);
      const StateColumns costate = gains_[k] * (behind_[k].eta - behind_[k].lambda * mean);
      ends.costates.middleCols(at, d_) = costate;
      next_ = mean + e.c * costate;
    }
    return ends;
  }
  BlockEnds fill(const StateColumns& first) { return fill(first, elements_.size()); }

  std::span<const BlockElement> elements_;
  const StateColumns &b_, &kappa_;
  Eigen::Index d_;
  std::vector<Information> behind_;
  std::vector<Eigen::Matrix2d> gains_;  // (1 + Λ C)^-1
  StateColumns next_;
};

}  // namespace

BlockEnds joined_blocks(std::span<const BlockElement> elements, const StateColumns& b, const StateColumns& kappa,
                        bool closed) {
  Joining joining(elements, b, kappa);
  return closed ? joining.closed() : joining.open();
}

}  // namespace batten
