// How a report looks, on the screen and on A4 paper.
#pragma once

namespace rockfold {

/// Rows, figures and facts are not parted by the end of a page; a table's heads come again on each.
inline constexpr const char* print_style = R"css(
@page { size: A4; margin: 16mm 14mm 18mm; @bottom-right { content: counter(page) " / " counter(pages); font: 8pt Helvetica, Arial, sans-serif; color: #5a6570; } }
* { box-sizing: border-box; }
body { font: 10.5pt/1.42 Helvetica, Arial, "DejaVu Sans", sans-serif; color: #15191e; background: #fff; max-width: 182mm; margin: 12mm auto; padding: 0 2mm; }
h1 { font-size: 20pt; line-height: 1.2; margin: 0 0 4mm; overflow-wrap: anywhere; }
h2 { font-size: 14pt; margin: 9mm 0 3mm; padding-bottom: 1mm; border-bottom: 0.5pt solid #9aa3ad; }
h3 { font-size: 11.5pt; margin: 6mm 0 2mm; }
h1, h2, h3, caption { break-after: avoid; }
p { margin: 2mm 0; }
.note { color: #5a6570; font-size: 9pt; }
table { border-collapse: collapse; width: 100%; margin: 3mm 0 5mm; font-size: 8.5pt; }
table.wide { font-size: 7pt; }
.wide th, .wide td { padding: 0.7mm 0.7mm; }
caption { text-align: left; font-weight: bold; padding: 0 0 1.5mm; }
thead { display: table-header-group; }
tr { break-inside: avoid; }
th, td { text-align: right; padding: 0.8mm 1.2mm; vertical-align: top; border-bottom: 0.4pt solid #ccd2d8; overflow-wrap: anywhere; }
td:not(.left) { white-space: nowrap; }
.facts td { white-space: normal; }
th { overflow-wrap: normal;  }
thead th { vertical-align: bottom; border-bottom: 0.8pt solid #333; }
thead small { font-weight: normal; color: #5a6570; }
.left, .facts th, .facts td { text-align: left; }
.facts { font-size: 9.5pt; }
.facts th { width: 42mm; font-weight: normal; color: #5a6570; overflow-wrap: normal; }
figure { margin: 4mm 0 5mm; break-inside: avoid; }
figure svg { width: 100%; height: auto; max-height: 105mm; display: block; }
figure img { width: 100%; height: auto; display: block; border: 0.4pt solid #ccd2d8; }
figcaption { font-size: 9pt; color: #5a6570; margin-top: 1mm; }
pre { font: 8pt/1.35 "DejaVu Sans Mono", Menlo, Consolas, monospace; white-space: pre-wrap; overflow-wrap: anywhere; margin: 2mm 0; }
.renderer { position: fixed; left: -3000px; top: 0; width: 1100px; height: 680px; }
.renderer main, .renderer canvas, .renderer .overlay { position: absolute; inset: 0; width: 100%; height: 100%; }
@media print { body { margin: 0; padding: 0; max-width: none; } .renderer { display: none; } }
)css";

}  // namespace rockfold
