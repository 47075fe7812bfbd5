#pragma once
/// Which pixels can show anything of the field.

#include "maggic/field.hpp"
#include "maggic/scan_area.hpp"

namespace maggic {

/// The pixels that see the field with `margin_mm` beyond its lines on every side, on the floor or
/// at any height up to the robots' tags; at most one span a row, a few pixels more rather than too
/// few. The whole picture while the field's corners are not known.
ScanArea field_area(const Field& field, double margin_mm);

}  // namespace maggic
