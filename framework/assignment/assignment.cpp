#include "assignment/assignment.hpp"

#include <algorithm>
#include <numeric>

#include "core/fill_with_room.hpp"

namespace maggic {
namespace {

// What counts as better: sums of the same scores in another order differ by less.
constexpr double kLeastGain = 1e-12;

}  // namespace

void AssignmentSolver::solve(std::span<const Contender> contenders,
                             std::span<const std::pair<int, int>> conflicts,
                             std::vector<int>& chosen) {
  chosen.clear();
  if (contenders.empty()) return;
  steps_ = 0;
  sort_into_groups(contenders);
  build_neighbors(conflicts);
  build_components(contenders, conflicts);
  for (std::size_t first = 0; first < branches_.size();) {
    std::size_t last = first + 1;
    while (last < branches_.size() && branches_[last].component == branches_[first].component) {
      ++last;
    }
    if (last == first + 1) {
      chosen.push_back(options_[branches_[first].begin].index);
    } else {
      solve_component(first, last);
      chosen.insert(chosen.end(), best_.begin(), best_.end());
    }
    first = last;
  }
  std::ranges::sort(chosen);
}

void AssignmentSolver::sort_into_groups(std::span<const Contender> contenders) {
  int groups = 0;
  int places = 0;
  int identities = 0;
  for (const Contender& contender : contenders) {
    groups = std::max(groups, contender.group + 1);
    places = std::max(places, contender.place + 1);
    identities = std::max(identities, contender.identity + 1);
  }
  fill_with_room(group_of_place_, places, -1);
  fill_with_room(group_of_identity_, identities, -1);
  fill_with_room(blocked_places_, places, 0);
  fill_with_room(taken_identities_, identities, 0);
  fill_with_room(prices_, identities, 0.0);
  fill_with_room(demands_, identities, {});
  fill_with_room(taken_groups_, groups, 0);

  // Counted one group further, so that filling moves every begin to its place.
  fill_with_room(group_begins_, groups + 2, 0);
  for (const Contender& contender : contenders) {
    if (contender.score > 0.0) ++group_begins_[contender.group + 2];
  }
  std::partial_sum(group_begins_.begin(), group_begins_.end(), group_begins_.begin());
  fill_with_room(options_, group_begins_.back(), {});
  for (int i = 0; i < static_cast<int>(contenders.size()); ++i) {
    const Contender& contender = contenders[i];
    if (!(contender.score > 0.0)) continue;
    int& next = group_begins_[contender.group + 1];
    options_[next++] = {contender.score, contender.place, contender.identity, i};
  }
}

void AssignmentSolver::build_neighbors(std::span<const std::pair<int, int>> conflicts) {
  for (const auto& [a, b] : conflicts) {
    const auto places = static_cast<std::size_t>(std::max(a, b)) + 1;
    if (places <= blocked_places_.size()) continue;
    blocked_places_.resize(places, 0);
    group_of_place_.resize(places, -1);
  }
  fill_with_room(neighbor_begins_, blocked_places_.size() + 2, 0);
  for (const auto& [a, b] : conflicts) {
    ++neighbor_begins_[a + 2];
    ++neighbor_begins_[b + 2];
  }
  std::partial_sum(neighbor_begins_.begin(), neighbor_begins_.end(), neighbor_begins_.begin());
  fill_with_room(neighbors_, conflicts.size() * 2, 0);
  for (const auto& [a, b] : conflicts) {
    neighbors_[neighbor_begins_[a + 1]++] = b;
    neighbors_[neighbor_begins_[b + 1]++] = a;
  }
}

void AssignmentSolver::build_components(std::span<const Contender> contenders,
                                        std::span<const std::pair<int, int>> conflicts) {
  fill_with_room(parents_, taken_groups_.size(), 0);
  std::iota(parents_.begin(), parents_.end(), 0);
  for (const Contender& contender : contenders) {
    if (!(contender.score > 0.0)) continue;
    group_of_place_[contender.place] = contender.group;
    if (contender.identity < 0) continue;
    int& group = group_of_identity_[contender.identity];
    if (group >= 0) unite(group, contender.group);
    group = contender.group;
  }
  for (const auto& [a, b] : conflicts) {
    const int group_a = group_of_place_[a];
    const int group_b = group_of_place_[b];
    if (group_a >= 0 && group_b >= 0) unite(group_a, group_b);
  }

  branches_.clear();
  fill_with_room(component_sizes_, parents_.size(), 0);
  for (int group = 0; group < static_cast<int>(parents_.size()); ++group) {
    const int begin = group_begins_[group];
    const int end = group_begins_[group + 1];
    if (begin == end) continue;
    std::sort(options_.begin() + begin, options_.begin() + end,
              [](const Option& a, const Option& b) {
                return a.score != b.score ? a.score > b.score : a.index < b.index;
              });
    const int component = root(group);
    component_sizes_[component] += end - begin;
    branches_.push_back({component, group, begin, end, options_[begin].score, 0.0});
  }
  std::ranges::sort(branches_, [&](const Branch& a, const Branch& b) {
    if (a.component != b.component) {
      const int size_a = component_sizes_[a.component];
      const int size_b = component_sizes_[b.component];
      return size_a != size_b ? size_a < size_b : a.component < b.component;
    }
    // The most valuable decision first, so that the bound bites early.
    return a.best != b.best ? a.best > b.best : a.group < b.group;
  });
}

int AssignmentSolver::root(int group) {
  while (parents_[group] != group) {
    int& parent = parents_[group];
    parent = parents_[parent];
    group = parent;
  }
  return group;
}

void AssignmentSolver::unite(int a, int b) {
  a = root(a);
  b = root(b);
  if (a != b) parents_[std::max(a, b)] = std::min(a, b);
}

void AssignmentSolver::solve_component(std::size_t first_branch, std::size_t last_branch) {
  component_ = std::span(branches_).subspan(first_branch, last_branch - first_branch);
  choose_greedily();
  price_identities();
  double prices = 0.0;
  for (const Branch& branch : component_) {
    for (int i = branch.begin; i < branch.end; ++i) {
      const int identity = options_[i].identity;
      if (identity < 0 || demands_[identity].most < 0.0) continue;
      prices += prices_[identity];
      demands_[identity].most = -1.0;
    }
  }
  sort_by_worth();
  current_.clear();
  search(0, 0.0, prices);
  if (steps_ > step_budget_) ++cut_short_;
}

// A price on every identity, taken off what its options are worth and added once in all, leaves a
// bound on what can be had; prices at which no two groups want one identity make it a close one.
void AssignmentSolver::price_identities() {
  constexpr int kMaxRounds = 20;
  for (int round = 0; round < kMaxRounds && raise_prices(); ++round) {
  }
}

bool AssignmentSolver::raise_prices() {
  for (const Branch& branch : component_) {
    double best = 0.0;
    double other = 0.0;  // of another identity, or none
    int wanted = -1;
    for (int i = branch.begin; i < branch.end; ++i) {
      const Option& option = options_[i];
      const double worth = priced(option);
      if (worth > best) {
        if (option.identity != wanted) other = best;
        best = worth;
        wanted = option.identity;
      } else if (worth > other && option.identity != wanted) {
        other = worth;
      }
    }
    if (wanted < 0) continue;
    Demand& demand = demands_[wanted];
    const double margin = best - other;
    if (margin > demand.most) {
      demand.second = demand.most;
      demand.most = margin;
    } else {
      demand.second = std::max(demand.second, margin);
    }
  }
  bool has_raised = false;
  for (std::size_t identity = 0; identity < demands_.size(); ++identity) {
    if (demands_[identity].second > kLeastGain) {
      prices_[identity] += demands_[identity].second;
      has_raised = true;
    }
    demands_[identity] = {};
  }
  return has_raised;
}

double AssignmentSolver::priced(const Option& option) const {
  return option.identity < 0 ? option.score : option.score - prices_[option.identity];
}

void AssignmentSolver::sort_by_worth() {
  by_worth_.resize(options_.size());
  for (Branch& branch : component_) {
    for (int i = branch.begin; i < branch.end; ++i) {
      by_worth_[i] = {priced(options_[i]), options_[i].place, options_[i].identity};
    }
    std::sort(by_worth_.begin() + branch.begin, by_worth_.begin() + branch.end,
              [](const Priced& a, const Priced& b) { return a.worth > b.worth; });
    branch.priced = std::max(by_worth_[branch.begin].worth, 0.0);
  }
  double remaining = 0.0;
  for (auto branch = component_.rbegin(); branch != component_.rend(); ++branch) {
    remaining += branch->priced;
    branch->remaining = remaining;
  }
}

void AssignmentSolver::choose_greedily() {
  by_score_.clear();
  for (const Branch& branch : component_) {
    for (int i = branch.begin; i < branch.end; ++i) {
      const Option& option = options_[i];
      by_score_.push_back({option.score, option.index, i, branch.group});
    }
  }
  std::ranges::sort(by_score_, [](const Ranked& a, const Ranked& b) {
    return a.score != b.score ? a.score > b.score : a.index < b.index;
  });
  best_.clear();
  best_score_ = 0.0;
  current_.clear();
  for (const Ranked& ranked : by_score_) {
    const Option& option = options_[ranked.option];
    char& is_taken = taken_groups_[ranked.group];
    if (is_taken || !is_free(option)) continue;
    is_taken = 1;
    best_.push_back(option.index);
    best_score_ += option.score;
    current_.push_back(ranked.option);
    take(option, 1);
  }
  for (const int option : current_) take(options_[option], -1);
}

void AssignmentSolver::search(std::size_t depth, double score, double prices) {
  if (score > best_score_ + kLeastGain) {
    best_score_ = score;
    best_ = current_;
  }
  if (depth == component_.size() || ++steps_ > step_budget_ ||
      !can_improve(depth, score + prices)) {
    return;
  }
  const Branch& branch = component_[depth];
  const double below = branch.remaining - branch.priced;
  for (int i = branch.begin; i < branch.end && steps_ <= step_budget_; ++i) {
    const Option& option = options_[i];
    if (score + prices + priced(option) + below <= best_score_ + kLeastGain || !is_free(option)) {
      continue;
    }
    const double price = option.identity < 0 ? 0.0 : prices_[option.identity];
    current_.push_back(option.index);
    take(option, 1);
    search(depth + 1, score + option.score, prices - price);
    take(option, -1);
    current_.pop_back();
  }
  search(depth + 1, score, prices);
}

// Whether `bound` and the best of what is still free in every group would beat the best found so
// far.
bool AssignmentSolver::can_improve(std::size_t depth, double bound) {
  const double needed = best_score_ + kLeastGain - bound;
  double possible = 0.0;
  for (std::size_t b = depth; b < component_.size(); ++b) {
    const Branch& branch = component_[b];
    if (possible + branch.remaining <= needed) return false;
    if (possible > needed) return true;
    for (int i = branch.begin; i < branch.end; ++i) {
      ++steps_;
      const Priced& option = by_worth_[i];
      if (option.worth <= 0.0) break;
      if (!is_free(option)) continue;
      possible += option.worth;
      break;
    }
  }
  return possible > needed;
}

template <class AnyOption>
bool AssignmentSolver::is_free(const AnyOption& option) const {
  return blocked_places_[option.place] == 0 &&
         (option.identity < 0 || !taken_identities_[option.identity]);
}

void AssignmentSolver::take(const Option& option, int step) {
  const auto place = option.place;
  for (int k = neighbor_begins_[place]; k < neighbor_begins_[place + 1]; ++k) {
    blocked_places_[neighbors_[k]] += step;
  }
  if (option.identity >= 0) {
    taken_identities_[option.identity] = step > 0 ? 1 : 0;
  }
}

}  // namespace maggic
