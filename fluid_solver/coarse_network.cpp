#include "fluid_solver/coarse_network.hpp"

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <algorithm>

namespace polynya::fluid {
namespace {

using Matrix = Eigen::SparseMatrix<double>;
using Lumps = std::vector<std::int32_t>;

constexpr int pairings = 3;            ///< lumps of up to eight
constexpr double least_share = 0.25;   ///< of the heaviest link, that makes a pair
/// Every connected part leaves a constant open: this part of the diagonal fixes it, far below what decides about
/// convergence and far above rounding.
constexpr double fixing = 1e-9;

/// Joins each of `count` nodes to the free neighbour with the heaviest link. for_links(node, body) calls body(other,
/// weight). Returns the number of lumps.
template <class ForLinks>
std::int32_t pair_up(std::int32_t count, ForLinks&& for_links, Lumps& lump) {
  lump.assign(static_cast<std::size_t>(count), -1);
  std::int32_t lumps = 0;
  for (std::int32_t node = 0; node < count; ++node) {
    if (lump[node] >= 0) continue;
    std::int32_t mate = -1;
    double heaviest = 0, best = 0;
    for_links(node, [&](std::int32_t other, double weight) {
      heaviest = std::max(heaviest, weight);
      if (lump[other] < 0 && weight > best) best = weight, mate = other;
    });
    lump[node] = lumps;
    if (mate >= 0 && best > least_share * heaviest) lump[mate] = lumps;
    ++lumps;
  }
  return lumps;
}

/// Sums of the links between lumps of `count` nodes, and what fixes the constant on the diagonal.
template <class ForLinks>
Matrix links_of_lumps(std::int32_t count, ForLinks&& for_links, const Lumps& lump, std::int32_t lumps) {
  std::vector<Eigen::Triplet<double, std::int32_t>> entries;
  entries.reserve(6 * static_cast<std::size_t>(count));
  for (std::int32_t node = 0; node < count; ++node) {
    for_links(node, [&](std::int32_t other, double weight) {
      if (lump[node] != lump[other]) entries.emplace_back(lump[other], lump[node], weight);
    });
  }
  Matrix links(lumps, lumps);
  links.setFromTriplets(entries.begin(), entries.end());
  return links;
}

/// The matrix of a network: sums of the links on the diagonal, their negatives beside it.
Matrix with_diagonal(const Matrix& links) {
  std::vector<Eigen::Triplet<double, std::int32_t>> entries;
  entries.reserve(static_cast<std::size_t>(links.nonZeros() + links.cols()));
  for (std::int32_t node = 0; node < links.cols(); ++node) {
    double sum = 0;
    for (Matrix::InnerIterator link(links, node); link; ++link) {
      sum += link.value();
      entries.emplace_back(link.row(), node, -link.value());
    }
    entries.emplace_back(node, node, sum > 0 ? (1 + fixing) * sum : 1.0);  // 1: a lump that nothing touches
  }
  Matrix matrix(links.rows(), links.cols());
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

}  // namespace

struct CoarseNetwork::Factors {
  Eigen::SimplicialLDLT<Matrix> solver;
  Eigen::VectorXd sums;
};

CoarseNetwork::CoarseNetwork(const CellNetwork& network) : factors_(std::make_unique<Factors>()) {
  const auto faces = [&network](std::int32_t cell, auto&& body) {
    for (int side = 0; side < 6; ++side) {
      if (network.weights[side][cell] > 0) body(network.neighbours[side][cell], network.weights[side][cell]);
    }
  };
  const std::int32_t cells = static_cast<std::int32_t>(network.size());
  std::int32_t lumps = pair_up(cells, faces, lump_);
  Matrix links = links_of_lumps(cells, faces, lump_, lumps);
  for (int pairing = 1; pairing < pairings; ++pairing) {
    const auto sums = [&links](std::int32_t node, auto&& body) {
      for (Matrix::InnerIterator link(links, node); link; ++link)
        body(static_cast<std::int32_t>(link.row()), link.value());
    };
    Lumps larger;
    const std::int32_t count = lumps;
    lumps = pair_up(count, sums, larger);
    links = links_of_lumps(count, sums, larger, lumps);
    for (std::int32_t& own : lump_) own = larger[own];
  }
  factors_->solver.compute(with_diagonal(links));
  factors_->sums.resize(lumps);
}
CoarseNetwork::~CoarseNetwork() = default;

void CoarseNetwork::add_correction(const std::vector<double>& residual, std::vector<double>& out) {
  Eigen::VectorXd& sums = factors_->sums;
  sums.setZero();
  for (std::size_t c = 0; c < lump_.size(); ++c) sums[lump_[c]] += residual[c];
  sums = factors_->solver.solve(sums);
  for (std::size_t c = 0; c < lump_.size(); ++c) out[c] += sums[lump_[c]];
}

}  // namespace polynya::fluid
