#include "report/html_page.hpp"

#include <fmt/format.h>

#include "maggic/base64.hpp"
#include "report/svg_canvas.hpp"

namespace maggic {
namespace {

constexpr std::string_view kStyle = R"(
:root { color-scheme: light dark; --ground: #ffffff; --ink: #1b1f24; --soft: #57606a;
  --line: #d0d7de; --card: #f6f8fa; }
@media (prefers-color-scheme: dark) {
  :root { --ground: #16191d; --ink: #e6e9ed; --soft: #a3abb5; --line: #3a4149; --card: #20252b; }
}
* { box-sizing: border-box; }
body { margin: 0 auto; padding: 1rem; max-width: 76rem; background: var(--ground);
  color: var(--ink); font: 16px/1.5 system-ui, sans-serif; }
h1 { font-size: 1.5rem; } h2 { font-size: 1.2rem; margin-top: 2.5rem; }
p, figcaption, small { color: var(--soft); }
.wide { overflow-x: auto; }
.paper { background: #ffffff; border: 1px solid var(--line); border-radius: 6px;
  margin: 0 0 1rem; overflow-x: auto; }
.paper svg { display: block; min-width: 34rem; width: 100%; height: auto; }
table { border-collapse: collapse; font-size: 0.92rem; }
th, td { border-bottom: 1px solid var(--line); padding: 0.3rem 0.7rem; text-align: right;
  vertical-align: top; font-variant-numeric: tabular-nums; white-space: nowrap; }
th:first-child, td:first-child { text-align: left; white-space: normal; min-width: 11rem; }
thead th { background: var(--card); }
td small { display: block; line-height: 1.3; }
table.facts td { text-align: left; white-space: normal; overflow-wrap: anywhere;
  min-width: 0; }
summary { cursor: pointer; padding: 0.4rem 0; }
figure { margin: 0 0 1.5rem; }
img { display: block; width: 100%; height: auto; border-radius: 4px; }
table.pictures { width: 100%; min-width: 40rem; }
table.pictures th, table.pictures td, table.pictures th:first-child { text-align: center;
  vertical-align: middle; min-width: 0; border: 0; padding: 0.2rem; white-space: normal; }
)";

}  // namespace

std::string html_page(std::string_view title, std::string_view body) {
  return fmt::format(
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<title>{0}</title>\n<style>{1}</style>\n</head>\n<body>\n<h1>{0}</h1>\n{2}</body>\n</"
      "html>\n",
      xml_escaped(title), kStyle, body);
}

std::string embedded_png(std::string_view png, std::string_view alt) {
  return fmt::format("<img alt=\"{}\" src=\"data:image/png;base64,{}\">", xml_escaped(alt),
                     base64(png));
}

}  // namespace maggic
