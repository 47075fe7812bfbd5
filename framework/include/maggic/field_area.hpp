#pragma once
/// Which pixels can show anything of the field.

#include "maggic/field.hpp"
#include "maggic/scan_area.hpp"

namespace maggic {

/// The pixels that see the field with `margin_mm` beyond its lines on every side, on the floor or
/// at any height up to the robots' tags; at most one span a row, a few pixels more rather than too
/// few. The whole picture while the field's corners are not known.
ScanArea field_area(const Field& field, double margin_mm);

/// How far beyond the field's lines lies what is seen at a pixel, mm, parallel to the side it lies
/// beyond the most; 0 within the lines. Of what may be seen there, on the floor or as high as the
/// tags, the nearer counts: this is the margin from which on `field_area` has the pixel. Finite.
double beyond_lines_mm(const Field& field, cv::Point2d point_px);

}  // namespace maggic
