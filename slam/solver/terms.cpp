// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/solver/terms.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "slam/factors/pose_manifold.h"

namespace vinebench::slam {
namespace {

constexpr std::size_t kMostResiduals = 6;

double squared_residual(const ceres::CostFunction& factor, const double* const* blocks) {
  std::array<double, kMostResiduals> residuals{};
  factor.Evaluate(blocks, residuals.data(), nullptr);
  double sum = 0;
  for (const double r : residuals) sum += r * r;
  return sum;
}

void read_sights(Terms& terms) {
  const Unknowns& unknowns = *terms.unknowns;
  terms.first.assign(unknowns.points.size() + 1, 0);
  for (std::size_t s = 0; s < unknowns.sights.size(); ++s) {
    terms.sights.push_back({static_cast<std::uint32_t>(s), unknowns.sights[s].pose});
    terms.first[unknowns.sights[s].point + 1] = s + 1;
  }
  // Points that nothing sees begin where they end.
  for (std::size_t p = 1; p < terms.first.size(); ++p) {
    terms.first[p] = std::max(terms.first[p], terms.first[p - 1]);
  }
  const auto at = [&](std::size_t s) {
    return terms.sights.begin() + static_cast<std::ptrdiff_t>(s);
  };
  for (std::size_t p = 0; p < unknowns.points.size(); ++p) {
    std::stable_sort(at(terms.first[p]), at(terms.first[p + 1]),
                     [](const auto& a, const auto& b) { return a.pose < b.pose; });
  }
}

}  // namespace

Terms read_terms(const ceres::Problem& problem, const Unknowns& unknowns) {
  Terms terms{&unknowns, {}, {}, 0, {}, {}, {}};
  std::unordered_map<const double*, std::size_t> rows;
  for (std::size_t i = 0; i < unknowns.poses.size(); ++i) {
    double* block = unknowns.poses[i];
    std::optional<std::size_t>& row = terms.row_of.emplace_back();
    if (problem.IsParameterBlockConstant(block)) continue;
    row = terms.rows.size();
    rows.emplace(block, *row);
    terms.rows.push_back({block, problem.ParameterBlockSize(block)});
    if (i < unknowns.chain) terms.chain = terms.rows.size();
  }
  read_sights(terms);

  std::vector<ceres::ResidualBlockId> ids;
  problem.GetResidualBlocks(&ids);
  std::vector<double*> blocks;
  for (const ceres::ResidualBlockId id : ids) {
    problem.GetParameterBlocksForResidualBlock(id, &blocks);
    Tie& tie = terms.ties.emplace_back(Tie{problem.GetCostFunctionForResidualBlock(id),
                                           problem.GetLossFunctionForResidualBlock(id),
                                           blocks.size(),
                                           {},
                                           {}});
    std::ranges::copy(blocks, tie.blocks.begin());
    for (std::size_t b = 0; b < blocks.size(); ++b) {
      const auto row = rows.find(blocks[b]);
      if (row != rows.end()) tie.rows[b] = row->second;
    }
  }
  return terms;
}

std::vector<Pose> chain_of(const Terms& terms) {
  std::vector<Pose> poses;
  poses.reserve(terms.unknowns->chain);
  for (std::size_t i = 0; i < terms.unknowns->chain; ++i) {
    poses.push_back(from_block(terms.unknowns->poses[i]));
  }
  return poses;
}

Weighed weigh(const ceres::LossFunction* loss, double squared_residual) {
  if (loss == nullptr) return {squared_residual / 2, 1};
  std::array<double, 3> rho{};  // the loss and its derivatives
  loss->Evaluate(squared_residual, rho.data());
  return {rho[0] / 2, std::sqrt(std::max(rho[1], 0.0))};
}

double cost_of(const Terms& terms) {
  const Unknowns& unknowns = *terms.unknowns;
  const std::vector<Pose> poses = chain_of(terms);
  double cost = 0;
  for (std::size_t p = 0; p < unknowns.points.size(); ++p) {
    const Eigen::Vector3d point(unknowns.points[p]);
    for (std::size_t s = terms.first[p]; s < terms.first[p + 1]; ++s) {
      const auto& [sight, pose] = terms.sights[s];
      cost += unknowns.factors->cost(sight, poses[pose], point);
    }
  }
  for (const Tie& tie : terms.ties) {
    cost += weigh(tie.loss, squared_residual(*tie.factor, tie.blocks.data())).cost;
  }
  return cost;
}

}  // namespace vinebench::slam
