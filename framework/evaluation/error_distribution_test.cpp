#include "maggic/error_distribution.hpp"

#include <cmath>
#include <vector>

#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

namespace maggic {
namespace {

TEST(ErrorDistribution, IsZeroWhileEmpty) {
  const ErrorDistribution empty;
  EXPECT_EQ(empty.rmse(), 0.0);
  EXPECT_EQ(empty.quantile(0.95), 0.0);
  EXPECT_EQ(empty.max(), 0.0);
}

TEST(ErrorDistribution, KeepsRootOfMeanSquareAndMaximumWhateverTheSign) {
  ErrorDistribution errors;
  errors.add(3.0);
  errors.add(-4.0);
  EXPECT_DOUBLE_EQ(errors.rmse(), std::sqrt(12.5));
  EXPECT_DOUBLE_EQ(errors.max(), 4.0);
  EXPECT_EQ(errors.count(), 2u);
}

TEST(ErrorDistribution, QuantilesAreExactToOnePercent) {
  ErrorDistribution errors;
  for (int i = 1; i <= 100; ++i) errors.add(0.1 * i);
  EXPECT_NEAR(errors.quantile(0.95), 9.5, 0.095);
  EXPECT_NEAR(errors.quantile(0.5), 5.0, 0.05);
}

TEST(ErrorDistribution, ErrorsOfZeroHaveQuantilesOfZero) {
  ErrorDistribution errors;
  for (int i = 0; i < 5; ++i) errors.add(0.0);
  EXPECT_EQ(errors.quantile(0.95), 0.0);
}

RC_GTEST_PROP(ErrorDistribution, MergingIsAsIfAllHadBeenAddedToOne,
              (const std::vector<std::uint16_t>& first, const std::vector<std::uint16_t>& second)) {
  ErrorDistribution apart;
  ErrorDistribution other;
  ErrorDistribution together;
  for (const std::uint16_t error : first) apart.add(error), together.add(error);
  for (const std::uint16_t error : second) other.add(error), together.add(error);
  apart.merge(other);
  RC_ASSERT(apart.count() == together.count());
  RC_ASSERT(apart.max() == together.max());
  RC_ASSERT(std::abs(apart.rmse() - together.rmse()) <= 1e-9 * (1.0 + together.rmse()));
  for (const double q : {0.1, 0.5, 0.95}) RC_ASSERT(apart.quantile(q) == together.quantile(q));
}

}  // namespace
}  // namespace maggic
