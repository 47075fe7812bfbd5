#pragma once
/// The order people expect of numbered files.

#include <string_view>

namespace maggic::images {

/// True when `a` comes before `b`: runs of digits compare as numbers of any length ("img2" before
/// "img10"), the rest byte by byte; equal numbers with fewer leading zeros come first. A strict
/// total order.
bool comes_naturally_before(std::string_view a, std::string_view b);

}  // namespace maggic::images
