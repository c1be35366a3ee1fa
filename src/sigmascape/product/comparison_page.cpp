#include "sigmascape/product/comparison_page.h"

#include <cstddef>
#include <fmt/format.h>
#include <fstream>
#include <iterator>
#include <string_view>

#include "sigmascape/base/error.h"
#include "sigmascape/geo/atomic_file.h"
#include "sigmascape/product/metric_text.h"

namespace sigmascape::product {
namespace {

constexpr std::string_view style = R"css(
:root { color-scheme: light dark; --ink: #1d2421; --soft: #5c6963; --line: #d5dcd8; --ground: #fbfcfb; }
@media (prefers-color-scheme: dark) { :root { --ink: #e2e8e4; --soft: #97a59e; --line: #33403a; --ground: #121614; } }
body { margin: 0 auto; max-width: 78rem; padding: 2.5rem 1.5rem 4rem; background: var(--ground); color: var(--ink);
       font: 1rem/1.55 system-ui, sans-serif; }
h1 { font-size: 1.7rem; font-weight: 600; margin: 0; }
h2 { font-size: 1.15rem; font-weight: 600; margin: 2.8rem 0 .6rem; }
p { max-width: 46rem; margin: .5rem 0; }
.lead, figcaption, .note, footer, dt { color: var(--soft); }
.figures { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(22rem, 100%), 1fr)); gap: 1.2rem; }
figure { margin: 0; }
figure img { width: 100%; height: auto; display: block; border-radius: 3px; }
figcaption { font-size: .9rem; padding-top: .4rem; }
table { border-collapse: collapse; margin: .8rem 0 .4rem; font-variant-numeric: tabular-nums; }
th, td { text-align: right; padding: .3rem .9rem .3rem 0; border-bottom: 1px solid var(--line); font-weight: 400; }
thead th { color: var(--soft); font-size: .9rem; }
td .floor { color: var(--soft); padding-left: .5rem; }
.note, footer { font-size: .85rem; }
dl { display: grid; grid-template-columns: max-content 1fr; gap: .25rem 1.5rem; margin: .8rem 0; }
dd { margin: 0; }
footer { margin-top: 3rem; border-top: 1px solid var(--line); padding-top: .8rem; }
)css";

std::string escaped(std::string_view text) {
  std::string html;
  for (const char c : text) {
    switch (c) {
      case '&':
        html += "&amp;";
        break;
      case '<':
        html += "&lt;";
        break;
      case '>':
        html += "&gt;";
        break;
      case '"':
        html += "&quot;";
        break;
      default:
        html += c;
    }
  }
  return html;
}

std::string base64(std::string_view bytes) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  const auto byte = [&](std::size_t i) -> unsigned {
    return i < bytes.size() ? static_cast<unsigned char>(bytes[i]) : 0U;
  };
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const unsigned triple = byte(i) << 16U | byte(i + 1) << 8U | byte(i + 2);
    text += digits[triple >> 18U];
    text += digits[triple >> 12U & 63U];
    text += i + 1 < bytes.size() ? digits[triple >> 6U & 63U] : '=';
    text += i + 2 < bytes.size() ? digits[triple & 63U] : '=';
  }
  return text;
}

std::string file_bytes(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  if (!file || bytes.empty())
    throw Error(path.string(), "the picture cannot be read", "write it before the page that shows it");
  return bytes;
}

std::string figures_html(const std::vector<PageFigure>& figures) {
  std::string html = "<div class=\"figures\">\n";
  for (const PageFigure& figure : figures) {
    html += fmt::format(
        "<figure><img alt=\"{0}\" src=\"data:image/png;base64,{1}\"><figcaption>{0}</figcaption></figure>\n",
        escaped(figure.caption), base64(file_bytes(figure.png)));
  }
  return html + "</div>\n";
}

std::string metric_row(const CellComparison& row, const CellComparison* floor) {
  std::string html = fmt::format("<tr><th scope=\"row\">{} m</th>", row.cell_m);
  for (const MetricColumn& column : metric_columns) {
    html += "<td>" + metric_text(column, row, "–");
    if (floor != nullptr) html += "<span class=\"floor\">" + metric_text(column, *floor, "–") + "</span>";
    html += "</td>";
  }
  return html + "</tr>\n";
}

std::string comparison_html(const MapComparison& comparison, const std::optional<MapComparison>& noise_floor) {
  std::string html = "<table><thead><tr><th scope=\"col\">cell</th>";
  for (const MetricColumn& column : metric_columns) html += fmt::format("<th scope=\"col\">{}</th>", column.heading);
  html += "</tr></thead><tbody>\n";
  for (const CellComparison& row : comparison.at) {
    html += metric_row(row, noise_floor ? noise_floor->at_cell(row.cell_m) : nullptr);
  }
  html += "</tbody></table>\n<p class=\"note\">";
  if (noise_floor) html += "Beside each number, paler, the noise floor: the truth against itself from another seed. ";
  return html + fmt::format(
                    "{}; dB no lower than {} dB; shadow is below {} dB, and no overlap is told of fewer than {} cells; "
                    "the bias is that of the total power, tested over "
                    "truth; relative L1 is the sum of absolute differences over the sum of the truth.</p>\n",
                    polarization_name(comparison.options.polarization), comparison.options.floor_db,
                    comparison.options.shadow_db, least_shadow_cells);
}

std::string facts_html(const std::vector<PageFact>& facts) {
  std::string html = "<dl>\n";
  for (const PageFact& fact : facts) {
    html += fmt::format("<dt>{}</dt><dd>{}</dd>\n", escaped(fact.name), escaped(fact.value));
  }
  return html + "</dl>\n";
}

std::string section_html(const PageSection& section) {
  std::string html = "<section>\n";
  if (!section.heading.empty()) html += fmt::format("<h2>{}</h2>\n", escaped(section.heading));
  for (const std::string& paragraph : section.paragraphs) html += fmt::format("<p>{}</p>\n", escaped(paragraph));
  if (!section.figures.empty()) html += figures_html(section.figures);
  if (section.comparison) html += comparison_html(*section.comparison, section.noise_floor);
  if (!section.facts.empty()) html += facts_html(section.facts);
  return html + "</section>\n";
}

}  // namespace

std::string comparison_page_html(const ComparisonPage& page) {
  std::string html = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<title>{0}</title>\n<style>{1}</style>\n</head>\n<body>\n<h1>{0}</h1>\n",
      escaped(page.title), style);
  if (!page.lead.empty()) html += fmt::format("<p class=\"lead\">{}</p>\n", escaped(page.lead));
  for (const PageSection& section : page.sections) html += section_html(section);
  if (!page.attribution.empty()) html += fmt::format("<footer>{}</footer>\n", escaped(page.attribution));
  return html + "</body>\n</html>\n";
}

void write_comparison_page(const std::filesystem::path& path, const ComparisonPage& page) {
  geo::write_atomically(path, comparison_page_html(page));
}

}  // namespace sigmascape::product
