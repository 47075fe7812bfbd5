#pragma once
/// Reports that are one HTML file: no script, nothing fetched from elsewhere.

#include <string>
#include <string_view>

namespace maggic {

/// A whole page: light or dark as the reader's system is, fit for a phone's width. What may be
/// wider than a phone goes into `<div class="wide">`, which scrolls by itself; a plot drawn for
/// white paper into `<div class="paper">`.
/// @param title plain text. @param body HTML.
std::string html_page(std::string_view title, std::string_view body);

/// An `<img>` that holds its picture itself. @param png bytes of a PNG file. @param alt plain text.
std::string embedded_png(std::string_view png, std::string_view alt);

}  // namespace maggic
