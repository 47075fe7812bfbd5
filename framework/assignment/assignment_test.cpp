#include "assignment/assignment.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <random>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace maggic {
namespace {

struct Problem {
  std::vector<Contender> contenders;
  std::vector<std::pair<int, int>> conflicts;  ///< Of places.

  bool exclude_each_other(const Contender& a, const Contender& b) const {
    return a.group == b.group || (a.identity >= 0 && a.identity == b.identity) ||
           std::ranges::count(conflicts, std::pair(a.place, b.place)) > 0 ||
           std::ranges::count(conflicts, std::pair(b.place, a.place)) > 0;
  }

  bool allows(unsigned subset) const {
    for (std::size_t i = 0; i < contenders.size(); ++i) {
      for (std::size_t k = 0; k < i; ++k) {
        if ((subset >> i & 1) && (subset >> k & 1) &&
            exclude_each_other(contenders[i], contenders[k])) {
          return false;
        }
      }
    }
    return true;
  }

  double worth(unsigned subset) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < contenders.size(); ++i) {
      if (subset >> i & 1) sum += contenders[i].score;
    }
    return sum;
  }
};

unsigned chosen_by(AssignmentSolver& solver, const Problem& problem) {
  std::vector<int> chosen;
  solver.solve(problem.contenders, problem.conflicts, chosen);
  EXPECT_TRUE(std::ranges::is_sorted(chosen));
  unsigned subset = 0;
  for (const int i : chosen) subset |= 1u << i;
  return subset;
}

/// Three in a row of which the middle one, worth most, excludes the others.
Problem three_in_a_row() { return {{{10.0, 0, 0}, {12.0, 1, 1}, {10.0, 2, 2}}, {{0, 1}, {1, 2}}}; }

Problem random_problem(std::mt19937& engine, int most) {
  const auto below = [&](int count) {
    return static_cast<int>(engine() % static_cast<unsigned>(count));
  };
  Problem problem;
  const int count = 1 + below(most);
  const int places = 1 + below(count);
  std::vector<int> group_of_place;
  for (int place = 0; place < places; ++place) group_of_place.push_back(below(places));
  for (int i = 0; i < count; ++i) {
    const int place = below(places);
    problem.contenders.push_back({-5.0 + 0.01 * below(2500),
                                  group_of_place[static_cast<std::size_t>(place)], place,
                                  below(count) - count / 2});
  }
  for (Contender& contender : problem.contenders) {
    contender.identity = std::max(contender.identity, -1);
  }
  for (int i = below(2 * places); i > 0; --i) {
    const int a = below(places);
    const int b = below(places);
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
    for (unsigned subset = 0; subset < 1u << problem.contenders.size(); ++subset) {
      if (problem.allows(subset)) best = std::max(best, problem.worth(subset));
    }
    const unsigned chosen = chosen_by(solver, problem);
    RC_ASSERT(problem.allows(chosen));
    RC_ASSERT(std::abs(problem.worth(chosen) - best) < 1e-9);
  }
  RC_ASSERT(solver.cut_short() == 0u);
}

TEST(AssignmentSolverTest, NeverChoosesAContenderWhoseWorthIsNoNumber) {
  AssignmentSolver solver;
  const double no_number = std::nan("");
  const Problem problem{{{no_number, 0, 0}, {2.0, 0, 1}, {no_number, 1, 2}, {no_number, 2, 3}}, {}};
  EXPECT_EQ(chosen_by(solver, problem), 0b0010u);
}

TEST(AssignmentSolverTest, GivesUpTheBestPairWhenTwoOthersAreWorthMore) {
  AssignmentSolver solver;
  EXPECT_EQ(chosen_by(solver, three_in_a_row()), 0b101u);
}

TEST(AssignmentSolverTest, WithoutBudgetIsStillAllowedAndAtLeastGreedyAndIsCounted) {
  AssignmentSolver solver(0);
  EXPECT_EQ(chosen_by(solver, three_in_a_row()), 0b010u);
  EXPECT_EQ(solver.cut_short(), 1u);
}

TEST(AssignmentSolverTest, AnIdentityGoesToWhomItIsWorthMost) {
  AssignmentSolver solver;
  const Problem problem{{{30.0, 0, 0, 7}, {29.0, 0, 0}, {28.0, 1, 1, 7}, {16.0, 1, 1}}, {}};
  EXPECT_EQ(chosen_by(solver, problem), 0b0110u);
}

TEST(AssignmentSolverTest, ManyGroupsThatWantOneIdentityAreNoHardCase) {
  // Each of 60 groups would like one of five identities and can do without. The bound has to know
  // that an identity is had once, or the search has 2^60 ways to try.
  constexpr int kGroups = 60;
  constexpr int kIdentities = 5;
  std::mt19937 engine(3);
  std::vector<Contender> contenders;
  std::array<double, kIdentities> most_gain{};
  double most = 0.0;
  for (int group = 0; group < kGroups; ++group) {
    const int identity = group % kIdentities;
    const double plain = 10.0 + 0.001 * static_cast<double>(engine() % 1000);
    const double gain = 8.0 + 0.001 * static_cast<double>(engine() % 1000);
    contenders.push_back({plain, group, group});
    contenders.push_back({plain + gain, group, group, identity});
    double& known = most_gain[static_cast<std::size_t>(identity)];
    known = std::max(known, gain);
    most += plain;
  }
  most = std::accumulate(most_gain.begin(), most_gain.end(), most);
  // One conflict a group, with nobody's choice, ties all of them into one component.
  std::vector<std::pair<int, int>> conflicts;
  for (int group = 0; group < kGroups; ++group) {
    contenders.push_back({0.5, group, kGroups + group});
    conflicts.emplace_back(kGroups + group, (group + 1) % kGroups);
  }
  AssignmentSolver solver;
  std::vector<int> chosen;
  solver.solve(contenders, conflicts, chosen);
  double worth = 0.0;
  for (const int i : chosen) worth += contenders[static_cast<std::size_t>(i)].score;
  EXPECT_NEAR(worth, most, 1e-9);
  EXPECT_EQ(solver.cut_short(), 0u);
}

TEST(AssignmentSolverTest, AHardComponentLeavesTheOthersTheirBudget) {
  // A ring of 60 equal places that exclude their neighbours, and a row of three.
  std::mt19937 engine(5);
  Problem problem;
  constexpr int kRing = 60;
  for (int i = 0; i < kRing; ++i) {
    problem.contenders.push_back({10.0 + 0.001 * static_cast<double>(engine() % 1000), i, i});
    for (const int step : {1, 2, 7}) problem.conflicts.emplace_back(i, (i + step) % kRing);
  }
  for (const double score : {10.0, 12.0, 10.0}) {
    const int place = static_cast<int>(problem.contenders.size());
    problem.contenders.push_back({score, place, place});
    if (place > kRing) problem.conflicts.emplace_back(place - 1, place);
  }
  AssignmentSolver solver(1000);
  std::vector<int> chosen;
  solver.solve(problem.contenders, problem.conflicts, chosen);
  EXPECT_EQ(solver.cut_short(), 1u);
  EXPECT_EQ(std::ranges::count(chosen, kRing), 1);
  EXPECT_EQ(std::ranges::count(chosen, kRing + 1), 0);
  EXPECT_EQ(std::ranges::count(chosen, kRing + 2), 1);
}

TEST(AssignmentSolverTest, NothingToChooseFromIsFine) {
  AssignmentSolver solver;
  EXPECT_EQ(chosen_by(solver, {}), 0u);
  EXPECT_EQ(chosen_by(solver, {{{-1.0, 0, 0}, {0.0, 1, 1}}, {}}), 0u);
}

}  // namespace
}  // namespace maggic
