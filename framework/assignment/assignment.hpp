#pragma once
/// Picks, of contenders some of which exclude each other, those that together are worth most.

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace maggic {

/// One of the things to choose from; some of them exclude each other.
struct Contender {
  double score = 0.0;  ///< Its worth; those of 0 or less, or NaN, are never chosen.
  /// From 0; at most one contender of a group is chosen. Groups are what the search branches on:
  /// few and large ones make it fast.
  int group = 0;
  int place = 0;      ///< From 0, belongs to one group; some places exclude each other.
  int identity = -1;  ///< From 0; at most one contender of an identity is chosen. -1: it has none.
};

/// Maximum-weight independent set. The contenders fall apart into components (for a tracker: robots
/// that touch neither each other nor each other's blobs, and are not taken for one another); each
/// is solved exactly by branch and bound. When the budget of steps is used up, every component left
/// keeps the best set found so far, which is never worse than greedy, and is counted. Small
/// components come first, so that a hard one cannot use up the budget of the others. Keeps its
/// memory from call to call.
class AssignmentSolver {
 public:
  /// @param step_budget contenders looked at in one call of `solve`; bounds its time.
  explicit AssignmentSolver(int step_budget = 40'000) : step_budget_(step_budget) {}

  /// @param conflicts pairs of places that exclude each other; a pair may occur twice.
  /// @param chosen receives the indices of the contenders chosen, ascending.
  void solve(std::span<const Contender> contenders, std::span<const std::pair<int, int>> conflicts,
             std::vector<int>& chosen);

  /// Components so far whose search was cut short.
  std::uint64_t cut_short() const { return cut_short_; }

 private:
  /// A contender where the search looks for it.
  struct Option {
    double score = 0.0;
    int place = 0;
    int identity = -1;
    int index = 0;  ///< Into the contenders.
  };
  /// The contenders of a group as a range of `options_`, best first.
  struct Branch {
    int component = 0;  ///< Number of a group of the component, the same for all of them.
    int group = 0;
    int begin = 0;
    int end = 0;
    double best = 0.0;       ///< Score of the first.
    double priced = 0.0;     ///< Most that an option is worth beyond its identity's price.
    double remaining = 0.0;  ///< Sum of `priced` from this branch to the component's last.
  };
  /// What an option is worth beyond its identity's price, in the order of that.
  struct Priced {
    double worth = 0.0;
    int place = 0;
    int identity = -1;
  };
  /// How much more than any other option the two keenest groups would give for an identity.
  struct Demand {
    double most = 0.0;
    double second = 0.0;
  };

  /// An option in the order greed goes by.
  struct Ranked {
    double score = 0.0;
    int index = 0;
    int option = 0;  ///< Into `options_`.
    int group = 0;
  };

  void sort_into_groups(std::span<const Contender> contenders);
  void build_neighbors(std::span<const std::pair<int, int>> conflicts);
  void build_components(std::span<const Contender> contenders,
                        std::span<const std::pair<int, int>> conflicts);
  int root(int group);
  void unite(int a, int b);
  void solve_component(std::size_t first_branch, std::size_t last_branch);
  void choose_greedily();
  void price_identities();
  bool raise_prices();
  double priced(const Option& option) const;
  void sort_by_worth();
  void search(std::size_t depth, double score, double prices);
  bool can_improve(std::size_t depth, double bound);
  template <class AnyOption>
  bool is_free(const AnyOption& option) const;
  void take(const Option& option, int step);

  int step_budget_;
  std::uint64_t cut_short_ = 0;
  std::vector<int> group_begins_;
  std::vector<Option> options_;   ///< A group after the other.
  std::vector<Branch> branches_;  ///< A component after the other.
  std::vector<int> parents_;      ///< Of groups.
  std::vector<int> group_of_place_;
  std::vector<int> group_of_identity_;
  std::vector<int> component_sizes_;
  std::vector<int> neighbor_begins_;
  std::vector<int> neighbors_;
  std::vector<int> blocked_places_;  ///< By how many chosen contenders each is excluded.
  std::vector<char> taken_identities_;
  std::span<Branch> component_;  ///< Being solved.
  std::vector<Ranked> by_score_;
  std::vector<double> prices_;    ///< Of identities.
  std::vector<Demand> demands_;   ///< For identities.
  std::vector<Priced> by_worth_;  ///< As `options_`, but each group ordered by worth.
  std::vector<char> taken_groups_;
  std::vector<int> current_;
  std::vector<int> best_;
  double best_score_ = 0.0;
  int steps_ = 0;
};

}  // namespace maggic
