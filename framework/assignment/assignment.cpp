#include "assignment/assignment.hpp"

#include <algorithm>
#include <numeric>

namespace maggic {

void AssignmentSolver::solve(std::span<const double> scores, std::span<const int> groups,
                             std::span<const std::pair<int, int>> conflicts,
                             std::vector<int>& chosen) {
  chosen.clear();
  if (scores.empty()) return;
  steps_ = 0;
  blocked_.assign(scores.size(), 0);
  build_neighbors(conflicts);
  build_components(scores, groups, conflicts);
  for (std::size_t begin = 0; begin < items_.size();) {
    const int component = root(items_[begin]);
    std::size_t end = begin;
    ordered_.clear();
    while (end < items_.size() && root(items_[end]) == component) ordered_.push_back(items_[end++]);
    solve_component(scores, groups);
    chosen.insert(chosen.end(), best_.begin(), best_.end());
    begin = end;
  }
  std::ranges::sort(chosen);
}

void AssignmentSolver::build_neighbors(std::span<const std::pair<int, int>> conflicts) {
  neighbor_begins_.assign(blocked_.size() + 1, 0);
  for (const auto& [a, b] : conflicts) {
    ++neighbor_begins_[static_cast<std::size_t>(a) + 1];
    ++neighbor_begins_[static_cast<std::size_t>(b) + 1];
  }
  std::partial_sum(neighbor_begins_.begin(), neighbor_begins_.end(), neighbor_begins_.begin());
  neighbors_.resize(conflicts.size() * 2);
  fill_.assign(neighbor_begins_.begin(), neighbor_begins_.end() - 1);
  for (const auto& [a, b] : conflicts) {
    neighbors_[fill_[a]++] = b;
    neighbors_[fill_[b]++] = a;
  }
}

void AssignmentSolver::build_components(std::span<const double> scores,
                                        std::span<const int> groups,
                                        std::span<const std::pair<int, int>> conflicts) {
  parents_.resize(scores.size());
  std::iota(parents_.begin(), parents_.end(), 0);
  for (const auto& [a, b] : conflicts) unite(a, b);
  group_items_.assign(static_cast<std::size_t>(*std::ranges::max_element(groups)) + 1, -1);
  items_.clear();
  for (int i = 0; i < static_cast<int>(scores.size()); ++i) {
    int& first_of_group = group_items_[groups[i]];
    if (first_of_group < 0) first_of_group = i;
    unite(first_of_group, i);
    if (scores[i] > 0.0) items_.push_back(i);
  }
  std::ranges::sort(items_, [&](int a, int b) {
    const int root_a = root(a);
    const int root_b = root(b);
    return root_a != root_b ? root_a < root_b : a < b;
  });
}

int AssignmentSolver::root(int item) {
  while (parents_[item] != item) {
    parents_[item] = parents_[parents_[item]];
    item = parents_[item];
  }
  return item;
}

void AssignmentSolver::unite(int a, int b) {
  a = root(a);
  b = root(b);
  if (a != b) parents_[std::max(a, b)] = std::min(a, b);
}

void AssignmentSolver::solve_component(std::span<const double> scores,
                                       std::span<const int> groups) {
  choose_greedily(scores, groups);
  std::ranges::sort(ordered_, [&](int a, int b) {
    if (groups[a] != groups[b]) return groups[a] < groups[b];
    return scores[a] != scores[b] ? scores[a] > scores[b] : a < b;
  });
  branches_.clear();
  for (std::size_t i = 0; i < ordered_.size(); ++i) {
    if (i == 0 || groups[ordered_[i]] != groups[ordered_[i - 1]]) branches_.push_back({i, i});
    branches_.back().end = i + 1;
  }
  // The most valuable decision first, so that the bound bites early.
  std::ranges::sort(branches_, [&](const Group& a, const Group& b) {
    const double score_a = scores[ordered_[a.begin]];
    const double score_b = scores[ordered_[b.begin]];
    return score_a != score_b ? score_a > score_b : a.begin < b.begin;
  });
  current_.clear();
  search(scores, 0, 0.0);
  if (steps_ > step_budget_ && branches_.size() > 1) ++cut_short_;
}

void AssignmentSolver::choose_greedily(std::span<const double> scores,
                                       std::span<const int> groups) {
  std::ranges::sort(ordered_, [&](int a, int b) {
    return scores[a] != scores[b] ? scores[a] > scores[b] : a < b;
  });
  best_.clear();
  best_score_ = 0.0;
  for (const int item : ordered_) {
    const auto same_group = [&](int other) { return groups[other] == groups[item]; };
    if (blocked_[item] > 0 || std::ranges::any_of(best_, same_group)) continue;
    best_.push_back(item);
    best_score_ += scores[item];
    block(item, 1);
  }
  for (const int item : best_) block(item, -1);
}

void AssignmentSolver::search(std::span<const double> scores, std::size_t depth, double score) {
  if (score > best_score_ + 1e-12) {
    best_score_ = score;
    best_ = current_;
  }
  if (depth == branches_.size() || ++steps_ > step_budget_) return;
  if (score + best_possible(scores, depth) <= best_score_ + 1e-12) return;
  const Group group = branches_[depth];
  for (std::size_t i = group.begin; i < group.end && steps_ <= step_budget_; ++i) {
    const int item = ordered_[i];
    if (blocked_[item] > 0) continue;
    current_.push_back(item);
    block(item, 1);
    search(scores, depth + 1, score + scores[item]);
    block(item, -1);
    current_.pop_back();
  }
  search(scores, depth + 1, score);
}

double AssignmentSolver::best_possible(std::span<const double> scores, std::size_t depth) {
  double total = 0.0;
  for (std::size_t g = depth; g < branches_.size(); ++g) {
    for (std::size_t i = branches_[g].begin; i < branches_[g].end; ++i) {
      ++steps_;
      if (blocked_[ordered_[i]] > 0) continue;
      total += scores[ordered_[i]];
      break;
    }
  }
  return total;
}

void AssignmentSolver::block(int item, int step) {
  for (int k = neighbor_begins_[item]; k < neighbor_begins_[item + 1]; ++k) {
    blocked_[neighbors_[k]] += step;
  }
}

}  // namespace maggic
