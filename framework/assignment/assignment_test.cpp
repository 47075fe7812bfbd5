#include "assignment/assignment.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace maggic {
namespace {

using Conflicts = std::vector<std::pair<int, int>>;

struct Problem {
  std::vector<double> scores;
  std::vector<int> groups;
  Conflicts conflicts;

  bool allows(unsigned subset) const {
    for (std::size_t i = 0; i < scores.size(); ++i) {
      for (std::size_t k = 0; k < i; ++k) {
        if ((subset >> i & 1) && (subset >> k & 1) && groups[i] == groups[k]) return false;
      }
    }
    for (const auto& [a, b] : conflicts) {
      if ((subset >> a & 1) && (subset >> b & 1)) return false;
    }
    return true;
  }

  double worth(unsigned subset) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < scores.size(); ++i) {
      if (subset >> i & 1) sum += scores[i];
    }
    return sum;
  }
};

unsigned chosen_by(AssignmentSolver& solver, const Problem& problem) {
  std::vector<int> chosen;
  solver.solve(problem.scores, problem.groups, problem.conflicts, chosen);
  unsigned subset = 0;
  for (const int i : chosen) subset |= 1u << i;
  return subset;
}

Problem random_problem(std::mt19937& engine, int most_items) {
  const auto below = [&](int count) {
    return static_cast<int>(engine() % static_cast<unsigned>(count));
  };
  Problem problem;
  const int items = 1 + below(most_items);
  for (int i = 0; i < items; ++i) {
    problem.scores.push_back(-5.0 + 0.01 * below(2500));
    problem.groups.push_back(below(items));
  }
  for (int i = below(2 * items); i > 0; --i) {
    const int a = below(items);
    const int b = below(items);
    if (a != b) problem.conflicts.emplace_back(a, b);
  }
  return problem;
}

RC_GTEST_PROP(AssignmentSolverTest, IsAsGoodAsTryingEverything, ()) {
  std::mt19937 engine(*rc::gen::arbitrary<std::uint32_t>());
  AssignmentSolver solver;
  for (int round = 0; round < 3; ++round) {
    const Problem problem = random_problem(engine, 12);
    double best = 0.0;
    for (unsigned subset = 0; subset < 1u << problem.scores.size(); ++subset) {
      if (problem.allows(subset)) best = std::max(best, problem.worth(subset));
    }
    const unsigned chosen = chosen_by(solver, problem);
    RC_ASSERT(problem.allows(chosen));
    RC_ASSERT(std::abs(problem.worth(chosen) - best) < 1e-9);
  }
  RC_ASSERT(solver.cut_short() == 0u);
}

TEST(AssignmentSolverTest, GivesUpTheBestPairWhenTwoOthersAreWorthMore) {
  AssignmentSolver solver;
  const Problem problem{{10.0, 12.0, 10.0}, {0, 1, 2}, {{0, 1}, {1, 2}}};
  EXPECT_EQ(chosen_by(solver, problem), 0b101u);
}

TEST(AssignmentSolverTest, WithoutBudgetIsStillAllowedAndAtLeastGreedyAndIsCounted) {
  AssignmentSolver solver(0);
  const Problem problem{{10.0, 12.0, 10.0}, {0, 1, 2}, {{0, 1}, {1, 2}}};
  EXPECT_EQ(chosen_by(solver, problem), 0b010u);
  EXPECT_EQ(solver.cut_short(), 1u);
}

TEST(AssignmentSolverTest, NothingToChooseFromIsFine) {
  AssignmentSolver solver;
  EXPECT_EQ(chosen_by(solver, {}), 0u);
  EXPECT_EQ(chosen_by(solver, {{-1.0, 0.0}, {0, 1}, {}}), 0u);
}

}  // namespace
}  // namespace maggic
