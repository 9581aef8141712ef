#include "eval/detail/style.hpp"

#include "eval/detail/text.hpp"

namespace sketchloc::detail {
namespace {

constexpr const char* kColours = R"css(
:root{color-scheme:light dark;--text:#1d2127;--soft:#5b6470;--back:#f5f6f8;--card:#fff;
--line:#d9dde3;--good:#00785a;--fair:#8a5a00;--bad:#b13800;--badge:#1d2127;--badge-text:#fff}
@media (prefers-color-scheme:dark){:root{--text:#e8eaed;--soft:#a4acb8;--back:#14171b;
--card:#1d2126;--line:#383e47;--good:#3ecfa3;--fair:#f0b63c;--bad:#ff8a50}
.chart .stroke,.chart path,.chart .legend i{filter:brightness(1.45)}}
)css";

constexpr const char* kText = R"css(
*{box-sizing:border-box}
body{margin:0 auto;max-width:70rem;padding:1rem;background:var(--back);color:var(--text);
font:16px/1.45 system-ui,"Segoe UI",Roboto,"Helvetica Neue",Arial,"DejaVu Sans",sans-serif}
h1{font-size:1.35rem;margin:.2rem 0;overflow-wrap:anywhere}
h2{font-size:1.15rem;margin:0 0 .6rem}h3{font-size:1rem;margin:1rem 0 .5rem}
p{margin:.4rem 0}.note,footer{color:var(--soft);font-size:.85rem;overflow-wrap:anywhere}
section{background:var(--card);border:1px solid var(--line);border-radius:.6rem;padding:1rem;
margin:0 0 1rem}
.definitions{position:absolute}
table{border-collapse:collapse;font-size:.92rem;margin:.4rem 0;font-variant-numeric:tabular-nums}
th,td{padding:.3rem .7rem .3rem 0;border-bottom:1px solid var(--line);text-align:right}
th[scope=row]{text-align:left;font-weight:normal;color:var(--soft)}
.facts td{text-align:left;overflow-wrap:anywhere}.scroll{overflow-x:auto}
.results td,.results th{vertical-align:top;white-space:nowrap}
.results td:nth-child(-n+2),.results th:nth-child(-n+2){text-align:left}
.results .interval{width:7rem;margin:.15rem 0 0 auto}
pre{overflow-x:auto;font-size:.8rem;line-height:1.35}summary{cursor:pointer;padding:.4rem 0}
)css";

constexpr const char* kVerdict = R"css(
.verdict{border-left:.5rem solid var(--soft)}.verdict h2{font-size:1.45rem;line-height:1.25}
.located{border-left-color:var(--good)}.located h2{color:var(--good)}
.partly{border-left-color:var(--fair)}.partly h2{color:var(--fair)}
.lost{border-left-color:var(--bad)}.lost h2{color:var(--bad)}
.tiles{display:grid;grid-template-columns:repeat(auto-fit,minmax(8.5rem,1fr));gap:.6rem}
.tile{border:1px solid var(--line);border-radius:.5rem;padding:.5rem .7rem}
.tile b{display:block;font-size:1.5rem;line-height:1.2}
.tile span{color:var(--soft);font-size:.85rem}
)css";

// Drawings stay on white paper in the dark too.
constexpr const char* kPictures = R"css(
.paper,.panels svg{background:#fff;border-radius:.3rem;border:1px solid var(--line)}
.picture{position:relative}svg{display:block;width:100%;height:auto}
.definitions{width:0;height:0}
.stroke{fill:none;stroke-linecap:round;stroke-linejoin:round;vector-effect:non-scaling-stroke}
.robot{stroke:#fff;stroke-width:1.5;stroke-linejoin:round;vector-effect:non-scaling-stroke}
.picture span{position:absolute;transform:translate(-50%,50%);pointer-events:none}
.start,.end{width:13px;height:13px;background:#fff;border:3px solid #1d2127}
.start{border-radius:50%}.end.reference{border-color:#0064be}
.picture b{position:absolute;left:14px;top:-8px;font-size:12px;line-height:16px;color:#1d2127;
white-space:nowrap;background:#ffffffd0;padding:0 3px;border-radius:3px}
.picture .left b{left:auto;right:14px}
.picture .reference b{color:#0064be;top:8px;display:none}
.badge{min-width:18px;height:18px;border-radius:9px;background:#1d2127;color:#fff;
border:1px solid #9aa;font:bold 11px/16px system-ui,sans-serif;text-align:center}
.badge.inline{display:inline-block}
.legend{display:flex;flex-wrap:wrap;gap:.2rem 1rem;font-size:.85rem;color:var(--soft);
font-weight:normal}
.legend span{display:inline-flex;align-items:center;gap:.4rem}
.legend i{display:inline-block;width:1.5rem;border-top:3px solid currentColor}
.legend i.dash{border-top-style:dashed}
.legend i.square{width:.7rem;height:.7rem;border:3px solid currentColor}
.legend i.area{border-top-width:.7rem;opacity:.35}
.legend i.dot{width:.6rem;height:.6rem;border:0;border-radius:50%;background:currentColor}
.panels{display:grid;gap:.8rem;grid-template-columns:repeat(2,1fr)}
.panels .notable{grid-column:span 2;grid-row:span 2}
.charts{display:grid;gap:0 1.5rem;grid-template-columns:repeat(auto-fill,minmax(min(26rem,100%),1fr))}
figure{margin:0}figcaption{font-size:.9rem;margin:.3rem 0}
)css";

constexpr const char* kCharts = R"css(
.chart{margin:0 0 1.4rem}.chart figcaption .legend{margin:.2rem 0 0}
.plot{position:relative;height:11rem;margin:1.6rem .6rem 2.6rem 2.7rem;
border-left:1px solid var(--soft);border-bottom:1px solid var(--soft)}
.plot svg{position:absolute;inset:0;height:100%;overflow:hidden}
.plot span{position:absolute;font-size:.78rem;line-height:1;color:var(--soft);white-space:nowrap}
.plot .ytick{right:100%;transform:translateY(50%);padding-right:.4rem}
.plot .xtick{top:100%;transform:translateX(-50%);padding-top:.4rem}
.plot .xunit{right:0;top:100%;padding-top:1.4rem}
.plot .guide{right:2px;transform:translateY(-2px)}
.plot .badge{color:#fff;top:-20px;transform:translateX(-50%);line-height:16px;font-size:11px}
line{vector-effect:non-scaling-stroke}line.grid{stroke:var(--line)}
line.guide{stroke:var(--text);stroke-dasharray:2 3;opacity:.7}
line.moment{stroke:var(--soft);opacity:.45}
@media(min-width:40rem){.panels{grid-template-columns:repeat(4,1fr)}
.panels.three{grid-template-columns:repeat(3,1fr)}.picture .reference b{display:inline}}
@media(max-width:40rem){body{padding:.5rem}section{padding:.7rem}.verdict h2{font-size:1.25rem}
.picture .badge{transform:translate(-50%,50%) scale(.85)}.picture .stroke{stroke-width:2}
table{font-size:.82rem}.scroll th,.scroll td{padding-right:.35rem;white-space:nowrap}}
@media print{section{break-inside:avoid}}
)css";

constexpr const char* kPlayer = R"css(
.player{display:grid;gap:.8rem;grid-template-columns:repeat(auto-fit,minmax(min(22rem,100%),1fr))}
.player canvas{display:block;width:100%;background:#fff;border:1px solid var(--line);
border-radius:.3rem}
.controls{display:flex;flex-wrap:wrap;gap:.4rem .8rem;align-items:center;margin:.6rem 0}
.controls input[type=range]{flex:1 1 12rem}.controls button{min-width:5rem}
.controls button,.controls select{font:inherit;padding:.15rem .6rem}
.state{min-height:3em;font-variant-numeric:tabular-nums}
)css";

}  // namespace

std::string open_page(std::string_view title, Scripts scripts) {
  return std::string("<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"/>") +
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>" +
         "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; "
         "img-src data:; style-src 'unsafe-inline'" +
         (scripts == Scripts::OwnAlone ? "; script-src 'unsafe-inline'" : "") + "\"/><title>" +
         escaped(title) + "</title><style>" + kColours + kText + kVerdict + kPictures + kCharts +
         kPlayer + "</style></head>\n<body>";
}

std::string close_page() {
  return "<footer>Made by sketchloc. Nothing on this page is loaded from elsewhere.</footer>"
         "</body></html>\n";
}

}  // namespace sketchloc::detail
