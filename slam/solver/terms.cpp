// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/solver/terms.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace vinebench::slam {
namespace {

using IndexOf = std::unordered_map<const double*, std::size_t>;

constexpr std::size_t kMostResiduals = 6;

std::optional<std::size_t> find(const IndexOf& indices, const double* block) {
  const auto found = indices.find(block);
  if (found == indices.end()) return std::nullopt;
  return found->second;
}

double squared_residual(const ceres::CostFunction& factor, const double* const* blocks) {
  std::array<double, kMostResiduals> residuals{};
  factor.Evaluate(blocks, residuals.data(), nullptr);
  double sum = 0;
  for (const double r : residuals) sum += r * r;
  return sum;
}

}  // namespace

Terms read_terms(const ceres::Problem& problem, const Unknowns& unknowns) {
  Terms terms;
  terms.points = unknowns.points;
  IndexOf points, poses;
  for (std::size_t i = 0; i < unknowns.points.size(); ++i) points.emplace(unknowns.points[i], i);
  for (std::size_t i = 0; i < unknowns.poses.size(); ++i) {
    double* block = unknowns.poses[i];
    if (problem.IsParameterBlockConstant(block)) continue;
    poses.emplace(block, terms.poses.size());
    terms.poses.push_back({block, problem.ParameterBlockSize(block)});
    if (i < unknowns.chain) terms.chain = terms.poses.size();
  }

  std::vector<ceres::ResidualBlockId> ids;
  problem.GetResidualBlocks(&ids);
  std::vector<double*> blocks;
  const auto point_of = [&](ceres::ResidualBlockId id) {
    problem.GetParameterBlocksForResidualBlock(id, &blocks);
    return blocks.size() == 2 ? find(points, blocks[1]) : std::nullopt;
  };
  terms.first.assign(terms.points.size() + 1, 0);
  for (const ceres::ResidualBlockId id : ids) {
    if (const auto point = point_of(id)) ++terms.first[*point + 1];
  }
  for (std::size_t i = 1; i < terms.first.size(); ++i) terms.first[i] += terms.first[i - 1];
  terms.sights.resize(terms.first.back());
  std::vector<std::size_t> next = terms.first;
  for (const ceres::ResidualBlockId id : ids) {
    const auto point = point_of(id);
    const ceres::CostFunction* factor = problem.GetCostFunctionForResidualBlock(id);
    const ceres::LossFunction* loss = problem.GetLossFunctionForResidualBlock(id);
    if (point) {
      terms.sights[next[*point]++] = {factor, loss, blocks[0], find(poses, blocks[0])};
      continue;
    }
    Tie& tie = terms.ties.emplace_back(Tie{factor, loss, blocks.size(), {}, {}});
    std::ranges::copy(blocks, tie.blocks.begin());
    for (std::size_t b = 0; b < blocks.size(); ++b) tie.poses[b] = find(poses, blocks[b]);
  }
  for (std::size_t p = 0; p < terms.points.size(); ++p) {
    std::stable_sort(terms.sights.begin() + static_cast<std::ptrdiff_t>(terms.first[p]),
                     terms.sights.begin() + static_cast<std::ptrdiff_t>(terms.first[p + 1]),
                     [](const Sight& a, const Sight& b) { return a.pose < b.pose; });
  }
  return terms;
}

Weighed weigh(const ceres::LossFunction* loss, double squared_residual) {
  if (loss == nullptr) return {squared_residual / 2, 1};
  std::array<double, 3> rho{};  // the loss and its derivatives
  loss->Evaluate(squared_residual, rho.data());
  return {rho[0] / 2, std::sqrt(std::max(rho[1], 0.0))};
}

double cost_of(const Terms& terms) {
  double cost = 0;
  for (std::size_t p = 0; p < terms.points.size(); ++p) {
    for (std::size_t s = terms.first[p]; s < terms.first[p + 1]; ++s) {
      const Sight& sight = terms.sights[s];
      const std::array<const double*, 2> blocks{sight.block, terms.points[p]};
      cost += weigh(sight.loss, squared_residual(*sight.factor, blocks.data())).cost;
    }
  }
  for (const Tie& tie : terms.ties) {
    cost += weigh(tie.loss, squared_residual(*tie.factor, tie.blocks.data())).cost;
  }
  return cost;
}

}  // namespace vinebench::slam
