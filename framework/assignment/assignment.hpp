#pragma once
/// Picks, of items some of which exclude each other, those that together are worth most.

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace maggic {

/// Maximum-weight independent set. The conflict graph falls apart into connected components (for a
/// tracker: robots that touch neither each other nor each other's blobs); each is solved exactly by
/// branch and bound. When the budget of steps is used up, every component left keeps the best choice
/// found so far, which is never worse than greedy, and is counted. Keeps its memory from call to
/// call.
class AssignmentSolver {
 public:
  /// @param step_budget items looked at in one call of `solve`; bounds its time.
  explicit AssignmentSolver(int step_budget = 100'000) : step_budget_(step_budget) {}

  /// @param scores worth of each item; items of 0 or less are never chosen.
  /// @param groups of each item a number from 0; at most one item of a group may be chosen. Groups
  ///   are what the search branches on: few and large ones make it fast.
  /// @param conflicts pairs of items that exclude each other; a pair may occur twice.
  /// @param chosen receives the indices of the chosen items, ascending.
  void solve(std::span<const double> scores, std::span<const int> groups,
             std::span<const std::pair<int, int>> conflicts, std::vector<int>& chosen);

  /// Components so far whose search was cut short.
  std::uint64_t cut_short() const { return cut_short_; }

 private:
  void build_neighbors(std::span<const std::pair<int, int>> conflicts);
  void build_components(std::span<const double> scores, std::span<const int> groups,
                        std::span<const std::pair<int, int>> conflicts);
  int root(int item);
  void unite(int a, int b);
  void solve_component(std::span<const double> scores, std::span<const int> groups);
  void choose_greedily(std::span<const double> scores, std::span<const int> groups);
  void search(std::span<const double> scores, std::size_t depth, double score);
  double best_possible(std::span<const double> scores, std::size_t depth);
  void block(int item, int step);

  struct Group {
    std::size_t begin = 0;  ///< Into ordered_; best item first.
    std::size_t end = 0;
  };

  int step_budget_;
  std::uint64_t cut_short_ = 0;
  std::vector<int> parents_;
  std::vector<int> group_items_;
  std::vector<int> neighbor_begins_;
  std::vector<int> neighbors_;
  std::vector<int> fill_;
  std::vector<int> items_;      ///< All items, a component after the other.
  std::vector<int> ordered_;    ///< Those of the current component, a group after the other.
  std::vector<Group> branches_;
  std::vector<int> blocked_;    ///< By how many chosen items each is excluded.
  std::vector<int> current_;
  std::vector<int> best_;
  double best_score_ = 0.0;
  int steps_ = 0;
};

}  // namespace maggic
